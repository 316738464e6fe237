//! The verifier: plan in, verdict out.

use std::sync::Arc;

use rayon::prelude::*;

use crate::scene::{
    Disturbance, Engine, Evidence, Goal, Job, Outcome, Plan, Record, Scene, Situation, Task, Tool,
    Verdict,
};
use crate::sim::Simulator;

use super::disturbance::Disturbed;

/// How thoroughly to verify.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VerifySettings {
    /// Disturbed replays in each engine.
    pub disturbed: usize,
    /// Seed of the disturbances.
    pub seed: u64,
}

/// Replays plans in both engines.
#[derive(Clone, Debug)]
pub struct Verifier {
    settings: VerifySettings,
    planar: Simulator,
    spatial: Simulator,
}

impl Verifier {
    /// A verifier on the engines at their default steps.
    pub fn new(settings: VerifySettings) -> Self {
        Self { settings, planar: Simulator::planar(), spatial: Simulator::spatial() }
    }

    /// Nominal replays in both engines; enough to tell whether a plan passes.
    ///
    /// `tool` is the one that the plan names.
    pub fn nominal(
        &self,
        task: &Task,
        situation: &Situation,
        tool: &Arc<Tool>,
        plan: &Plan,
    ) -> Verdict {
        let job = Job::new(situation, plan.motion(tool));
        let mut evidence: Vec<Evidence> = [&self.spatial, &self.planar]
            .into_par_iter()
            .map(|engine| replay(engine, &task.goal, &situation.scene, &job, Disturbance::Nominal))
            .collect();
        let passed = evidence[0].outcome.reached;
        // The planar engine is the one that people compare predictions with: it comes first.
        evidence.reverse();
        Verdict { passed, evidence, robustness: None }
    }

    /// Adds the disturbed replays to the verdict of [`Verifier::nominal`].
    pub fn disturb(
        &self,
        task: &Task,
        situation: &Situation,
        tool: &Arc<Tool>,
        plan: &Plan,
        verdict: &mut Verdict,
    ) {
        if self.settings.disturbed == 0 {
            return;
        }
        let motion = plan.motion(tool);
        let draws: Vec<(&Simulator, usize)> = [&self.planar, &self.spatial]
            .into_iter()
            .flat_map(|engine| (0..self.settings.disturbed).map(move |draw| (engine, draw)))
            .collect();
        let replays: Vec<Evidence> = draws
            .into_par_iter()
            .map(|(engine, draw)| {
                let job = Disturbed::draw(situation, tool, self.settings.seed, draw).job(&motion);
                let disturbance = Disturbance::Disturbed { draw: draw + 1 };
                replay(engine, &task.goal, &situation.scene, &job, disturbance)
            })
            .collect();
        verdict.evidence.extend(replays);
        let reached = verdict.disturbed(Engine::Spatial).filter(|e| e.outcome.reached).count();
        verdict.robustness = Some(reached as f64 / self.settings.disturbed as f64);
    }

    /// All replays of a plan: nominal, then disturbed.
    pub fn verify(
        &self,
        task: &Task,
        situation: &Situation,
        tool: &Arc<Tool>,
        plan: &Plan,
    ) -> Verdict {
        let mut verdict = self.nominal(task, situation, tool, plan);
        self.disturb(task, situation, tool, plan, &mut verdict);
        verdict
    }
}

/// Plays a job; one without pushes leaves everything where it is.
fn replay(
    engine: &Simulator,
    goal: &Goal,
    scene: &Scene,
    job: &Job,
    disturbance: Disturbance,
) -> Evidence {
    let nominal = disturbance == Disturbance::Nominal;
    let record = if nominal { Record::Frames } else { Record::Outcome };
    let trajectory = engine.run(scene, job, record);
    Evidence {
        engine: engine.engine(),
        disturbance,
        outcome: Outcome::judge(goal, &trajectory),
        warnings: trajectory.warnings.clone(),
        trajectory: nominal.then_some(trajectory),
    }
}
