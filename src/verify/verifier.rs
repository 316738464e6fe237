//! The verifier: plan in, verdict out.

use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::Pose;
use crate::scene::{
    Disturbance, Evidence, Job, Outcome, Plan, Record, Scene, Situation, Task, Tool, Trajectory,
    Verdict, Warning,
};
use crate::sim::Simulator;
use crate::watch::{Unwatched, Watch};

use super::disturbance::Disturbed;
use super::rules::broken_rules;

/// Processor time of a time step for each object, seconds: with one object 1 and 6 us were measured,
/// with nine 0.5 and 5.
const PLANAR_STEP: f64 = 1e-6;
const SPATIAL_STEP: f64 = 6e-6;

/// How thoroughly to verify.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VerifySettings {
    /// Disturbed replays in each engine.
    pub disturbed: usize,
    /// Seed of the disturbances.
    pub seed: u64,
}

/// Replays plans in both engines.
#[derive(Clone)]
pub struct Verifier<'a> {
    settings: VerifySettings,
    planar: Simulator,
    spatial: Simulator,
    watch: &'a dyn Watch,
}

impl<'a> Verifier<'a> {
    /// A verifier on the engines at their default steps.
    pub fn new(settings: VerifySettings) -> Self {
        let (planar, spatial) = (Simulator::planar(), Simulator::spatial());
        Self { settings, planar, spatial, watch: &Unwatched }
    }

    /// The same, which `watch` can stop. Replays that are not over then say so, and the plan does
    /// not pass.
    pub fn watched(self, watch: &'a dyn Watch) -> Self {
        Self { watch, ..self }
    }

    /// About how long verifying a plan takes on one core, seconds: right to within a factor of
    /// three unless everything is pushed into everything.
    pub fn seconds(&self, scene: &Scene, plan: &Plan) -> f64 {
        let moving: f64 = plan.pushes.iter().map(|push| push.length / push.speed).sum();
        let each = [(&self.planar, PLANAR_STEP), (&self.spatial, SPATIAL_STEP)];
        let replay: f64 = each.iter().map(|(engine, cost)| moving / engine.step() * cost).sum();
        replay * scene.objects.len() as f64 * (self.settings.disturbed + 1) as f64
    }

    /// Nominal replays in both engines; enough to tell whether a plan works as written.
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
            .map(|engine| self.replay(engine, task, &situation.scene, &job, Disturbance::Nominal))
            .collect();
        // The planar engine is the one that people compare predictions with: it comes first.
        evidence.reverse();
        Verdict::judge(broken_rules(task, &situation.scene, tool, plan), evidence, task.robustness)
    }

    /// The verdict of [`Verifier::nominal`] together with the disturbed replays.
    pub fn disturb(
        &self,
        task: &Task,
        situation: &Situation,
        tool: &Arc<Tool>,
        plan: &Plan,
        verdict: Verdict,
    ) -> Verdict {
        let motion = plan.motion(tool);
        let draws: Vec<(&Simulator, usize)> = [&self.planar, &self.spatial]
            .into_iter()
            .flat_map(|engine| (0..self.settings.disturbed).map(move |draw| (engine, draw)))
            .collect();
        let replays: Vec<Evidence> = draws
            .into_par_iter()
            .map(|(engine, draw)| {
                let disturbance = Disturbance::Disturbed { draw: draw + 1 };
                if self.watch.cancelled() {
                    return stopped(engine, task, situation, disturbance);
                }
                let job = Disturbed::draw(situation, tool, self.settings.seed, draw).job(&motion);
                self.replay(engine, task, &situation.scene, &job, disturbance)
            })
            .collect();
        let Verdict { forbidden, mut evidence, .. } = verdict;
        evidence.extend(replays);
        Verdict::judge(forbidden, evidence, task.robustness)
    }

    /// All replays of a plan: nominal, then disturbed.
    pub fn verify(
        &self,
        task: &Task,
        situation: &Situation,
        tool: &Arc<Tool>,
        plan: &Plan,
    ) -> Verdict {
        let nominal = self.nominal(task, situation, tool, plan);
        self.disturb(task, situation, tool, plan, nominal)
    }

    /// Plays a job; one without pushes leaves everything where it is.
    fn replay(
        &self,
        engine: &Simulator,
        task: &Task,
        scene: &Scene,
        job: &Job,
        disturbance: Disturbance,
    ) -> Evidence {
        let nominal = disturbance == Disturbance::Nominal;
        let record = if nominal { Record::Frames } else { Record::Outcome };
        let mut trajectory = engine.run_watched(scene, job, record, self.watch);
        if let (Some(force), Some(limit)) = (trajectory.force, task.robot.max_force)
            && force.lasting > limit
        {
            let needed = force.lasting;
            trajectory.warnings.push(Warning::TooMuchForce { needed, limit });
        }
        Evidence {
            engine: engine.engine(),
            disturbance,
            outcome: Outcome::judge(&task.goal, &trajectory),
            warnings: trajectory.warnings.clone(),
            force: trajectory.force,
            trajectory: nominal.then_some(trajectory),
        }
    }
}

/// A replay that was stopped before it began: thousands of draws would take a minute to be made for
/// nothing.
fn stopped(
    engine: &Simulator,
    task: &Task,
    situation: &Situation,
    disturbance: Disturbance,
) -> Evidence {
    let start = situation.start.clone();
    let mut trajectory = Trajectory::standing(engine.spec(), Pose::default(), start);
    trajectory.warnings.push(Warning::Stopped);
    Evidence {
        engine: engine.engine(),
        disturbance,
        outcome: Outcome::judge(&task.goal, &trajectory),
        warnings: trajectory.warnings,
        force: None,
        trajectory: None,
    }
}
