//! One rollout to compute: what an effect model takes.

use std::sync::Arc;

use super::{Hypothesis, State, ToolMotion};

/// One rollout to compute.
#[derive(Clone, Debug)]
pub struct Job {
    /// Poses and velocities at the start.
    pub start: State,
    /// What the tool does.
    pub motion: ToolMotion,
    /// Other physical parameters than the scene's, where wanted.
    pub hypothesis: Option<Arc<Hypothesis>>,
}
