//! One rollout to compute: what an effect model takes.

use std::sync::Arc;

use super::{Physics, Scene, Situation, State, ToolMotion};

/// One rollout to compute.
#[derive(Clone, Debug)]
pub struct Job {
    /// Poses and velocities at the start.
    pub start: State,
    /// What the tool does.
    pub motion: ToolMotion,
    /// Under which physical parameters.
    pub physics: Arc<Physics>,
}

impl Job {
    /// `motion`, beginning in `situation`.
    pub fn new(situation: &Situation, motion: ToolMotion) -> Self {
        let Situation { start, physics, .. } = situation;
        Self { start: start.clone(), motion, physics: Arc::clone(physics) }
    }

    /// `motion` in the scene exactly as it is stated.
    pub fn stated(scene: &Scene, motion: ToolMotion) -> Self {
        Self { start: scene.start(), motion, physics: Arc::new(Physics::stated(scene)) }
    }
}
