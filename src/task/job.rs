//! The input of an effect model: a single rollout.

use std::sync::Arc;

use super::{Motion, Stroke, ToolMotion};
use crate::scene::{Physics, Scene, Situation, State};

/// A rollout to compute.
#[derive(Clone, Debug)]
pub struct Job {
    /// Poses and velocities at the start.
    pub start: State,
    /// Motion of the tool.
    pub motion: Motion,
    /// Physical parameters.
    pub physics: Arc<Physics>,
}

impl Job {
    /// Creates the rollout of `motion` from `situation`.
    pub fn new(situation: &Situation, motion: impl Into<Motion>) -> Self {
        let Situation { start, physics, .. } = situation;
        Self { start: start.clone(), motion: motion.into(), physics: Arc::clone(physics) }
    }

    /// Creates the rollout of `motion` in the scene exactly as stated.
    pub fn stated(scene: &Scene, motion: impl Into<Motion>) -> Self {
        Self {
            start: scene.start(),
            motion: motion.into(),
            physics: Arc::new(Physics::stated(scene)),
        }
    }

    /// Creates the rollouts of consecutive `motions`, the first from `situation`; see
    /// [`in_turn`](crate::outcome::in_turn).
    pub fn sequence(situation: &Situation, motions: &[ToolMotion]) -> Vec<Self> {
        motions.iter().map(|motion| Self::new(situation, motion.clone())).collect()
    }

    /// Returns a job for each part of the motion after which everything settles and the tool may be
    /// lifted. All start where this job starts, see [`in_turn`](crate::outcome::in_turn).
    pub fn stages(&self) -> Vec<Self> {
        let Motion::Slide(motion) = &self.motion else { return vec![self.clone()] };
        let parts = motion.strokes.split_inclusive(|stroke| stroke.settle);
        let stage = |strokes: &[Stroke]| {
            let motion = ToolMotion { strokes: strokes.to_vec(), ..motion.clone() };
            Self { motion: motion.into(), ..self.clone() }
        };
        let stages: Vec<Self> = parts.map(stage).collect();
        if stages.is_empty() { vec![self.clone()] } else { stages }
    }

    /// Returns `true` if it leaves the plane or starts out of it, so that it needs a 3-D model.
    pub fn in_space(&self) -> bool {
        self.motion.is_lever() || self.start.space.is_some()
    }
}
