//! Counted access to the effect model for all rollouts of planning.

use std::sync::Arc;

use crate::effect::{EffectModel, Job};
use crate::{
    outcome::{Record, Trajectory, in_turn},
    scene::{Situation, State, Tool},
    task::{Push, Stroke, ToolMotion},
};

/// Effect model in one situation, with a count of its rollouts.
pub struct Rollouts<'a> {
    model: &'a dyn EffectModel,
    situation: Situation,
    used: usize,
}

impl<'a> Rollouts<'a> {
    /// Creates the access with a count of zero.
    pub fn new(model: &'a dyn EffectModel, situation: Situation) -> Self {
        Self { model, situation, used: 0 }
    }

    /// Returns the number of rollouts so far.
    pub fn used(&self) -> usize {
        self.used
    }

    /// Counts rollouts made elsewhere for this planning.
    pub fn count(&mut self, rollouts: usize) {
        self.used += rollouts;
    }

    /// Returns the start of planning and the physics of all rollouts.
    pub fn situation(&self) -> &Situation {
        &self.situation
    }

    /// Returns the job of `motion` from the state `start`.
    pub(super) fn job(&self, motion: ToolMotion, start: State) -> Job {
        Job { start, motion: motion.into(), physics: Arc::clone(&self.situation.physics) }
    }

    /// Rolls out sequences of jobs, each as one trajectory, and counts the jobs (see [`in_turn`]).
    pub fn in_turn(&mut self, sequences: &[Vec<Job>], record: Record) -> Vec<Trajectory> {
        in_turn(sequences, record, |jobs| self.run(jobs, record))
    }

    /// Rolls out a batch in parallel and counts it.
    pub fn run(&mut self, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        self.used += jobs.len();
        self.model.rollout(&self.situation.scene, jobs, record)
    }
}

/// Returns a straight push that ends at rest.
pub(super) fn single_push(tool: &Arc<Tool>, lift: f64, grip_yaw: f64, push: &Push) -> ToolMotion {
    ToolMotion::pushes(Arc::clone(tool), lift, grip_yaw, std::slice::from_ref(push), true)
}

/// Returns the moving frames of a recorded single stroke and the tool's travel up to each:
/// `(frame, travel)`.
pub(super) fn stops(stroke: &Stroke, recorded: usize) -> impl Iterator<Item = (usize, f64)> {
    let (frames, travel) = (stroke.frames(), stroke.travel());
    (1..=frames.min(recorded.saturating_sub(1)))
        .map(move |k| (k, travel * k as f64 / frames as f64))
}
