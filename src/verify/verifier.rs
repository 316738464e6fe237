//! The verifier: plan in, verdict out.

use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::{Pose, clearance};
use crate::scene::{
    Evidence, Frame, Goal, Job, Outcome, Plan, Record, Scene, Situation, State, Task, Tool,
    ToolMotion, Trajectory, Verdict, Warning,
};
use crate::sim::Simulator;

use super::disturbance::Disturbance;

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
            .map(|engine| replay(engine, &task.goal, &situation.scene, &job, None))
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
                let disturbance = Disturbance::draw(situation, tool, self.settings.seed, draw);
                let job = disturbance.job(&motion);
                replay(engine, &task.goal, &situation.scene, &job, Some(&disturbance))
            })
            .collect();
        let spatial = replays.iter().filter(|e| e.engine == self.spatial.engine());
        let reached = spatial.filter(|e| e.outcome.reached).count();
        verdict.robustness = Some(reached as f64 / self.settings.disturbed as f64);
        verdict.evidence.extend(replays);
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

fn replay(
    engine: &Simulator,
    goal: &Goal,
    scene: &Scene,
    job: &Job,
    disturbance: Option<&Disturbance>,
) -> Evidence {
    let Job { start, motion, .. } = job;
    // Frames are needed to see on what the tool comes down for a later stroke.
    let record = if motion.strokes.len() > 1 { Record::Frames } else { Record::Outcome };
    let mut trajectory = if motion.strokes.is_empty() {
        Trajectory { frames: vec![standing(start)], ..Trajectory::default() }
    } else {
        engine.run(scene, job, record)
    };
    let landings = set_down_on(scene, start, motion, &trajectory);
    trajectory.warnings.extend(landings);
    Evidence {
        engine: engine.engine(),
        disturbance: disturbance.map_or("nominal".into(), Disturbance::to_string),
        outcome: Outcome::judge(goal, &trajectory),
        warnings: trajectory.warnings,
    }
}

/// What a plan without pushes leaves.
fn standing(start: &State) -> Frame {
    Frame { time: 0.0, stroke: 0, tool: Pose::default(), state: start.clone() }
}

/// Objects that the tool comes down on, at the first stroke and after every settled one.
fn set_down_on(
    scene: &Scene,
    start: &State,
    motion: &ToolMotion,
    trajectory: &Trajectory,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for (index, stroke) in motion.strokes.iter().enumerate() {
        let state = match index.checked_sub(1) {
            None => Some(start),
            Some(before) if motion.strokes[before].settle => {
                let frames = trajectory.frames.iter().rev();
                frames.into_iter().find(|frame| frame.stroke == before).map(|frame| &frame.state)
            }
            Some(_) => None,
        };
        let Some(state) = state else { continue };
        for (object, pose) in scene.objects.iter().zip(&state.poses) {
            let still = (&object.shape.footprint(), pose);
            let overlaps = motion.lift < object.shape.height()
                && motion.tool.parts.iter().enumerate().any(|(k, part)| {
                    let pose = motion.tool.part_pose(k, &stroke.from);
                    clearance((&part.footprint(), &pose), still, 1e-3) <= 0.0
                });
            if overlaps {
                warnings.push(Warning::SetDownOn { object: object.name.clone(), stroke: index });
            }
        }
    }
    warnings
}
