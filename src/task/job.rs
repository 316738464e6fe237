//! One rollout to compute: what an effect model takes.

use std::sync::Arc;

use super::{Motion, ToolMotion};
use crate::scene::{Physics, Scene, Situation, State};

/// One rollout to compute.
#[derive(Clone, Debug)]
pub struct Job {
    /// Poses and velocities at the start.
    pub start: State,
    /// What the tool does.
    pub motion: Motion,
    /// Under which physical parameters.
    pub physics: Arc<Physics>,
}

impl Job {
    /// `motion`, beginning in `situation`.
    pub fn new(situation: &Situation, motion: impl Into<Motion>) -> Self {
        let Situation { start, physics, .. } = situation;
        Self { start: start.clone(), motion: motion.into(), physics: Arc::clone(physics) }
    }

    /// `motion` in the scene exactly as it is stated.
    pub fn stated(scene: &Scene, motion: impl Into<Motion>) -> Self {
        Self {
            start: scene.start(),
            motion: motion.into(),
            physics: Arc::new(Physics::stated(scene)),
        }
    }

    /// `motions` in turn, the first beginning in `situation`: see [`in_turn`](crate::outcome::in_turn).
    pub fn sequence(situation: &Situation, motions: &[ToolMotion]) -> Vec<Self> {
        motions.iter().map(|motion| Self::new(situation, motion.clone())).collect()
    }

    /// Whether it leaves the plane, or begins out of it: for models in space.
    pub fn in_space(&self) -> bool {
        self.motion.is_lever() || self.start.space.is_some()
    }
}
