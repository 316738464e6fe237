//! Nothing moves.

use crate::{
    effect::{EffectModel, Job},
    geometry::Pose,
    scene::{Physics, Record, Scene, ToolMotion, Trajectory, Warning},
};

use super::play::{Rule, Table, play_all};

/// Objects stay where they are, whatever the tool does.
#[derive(Clone, Copy, Debug, Default)]
pub struct Still;

struct Nothing;

impl Rule for Nothing {
    fn begin(_: &Scene, _: &Physics) -> Self {
        Nothing
    }

    fn step(&mut self, _: &Table, _: &Pose, _: &Pose, _: &mut [Pose]) {}
}

impl EffectModel for Still {
    fn name(&self) -> &str {
        "still"
    }

    fn warnings(&self, _: &Scene, _: &ToolMotion) -> Vec<Warning> {
        Vec::new()
    }

    /// Unknown, and no smaller than the longest motion.
    fn error_p95(&self) -> f64 {
        f64::INFINITY
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        play_all::<Nothing>(scene, jobs, record)
    }
}
