//! The prior as an effect model: the closed-form solution of every frame, uncorrected.

use rayon::prelude::*;

use crate::{
    rollout::{RollSettings, Roller},
    scene::{Job, Record, Scene, ToolMotion, Trajectory, Warning},
};

use super::{
    EffectModel,
    network::{CHUNK, stride_name},
};

/// The prior alone, without any network: the cheapest level with physics in it.
#[derive(Clone, Debug)]
pub struct Prior {
    name: String,
    settings: RollSettings,
}

impl Prior {
    /// The same with `stride` frames predicted as one.
    pub fn with_stride(mut self, stride: usize) -> Self {
        self.settings.stride = stride.max(1);
        self.name += &stride_name(stride);
        self
    }
}

impl Default for Prior {
    fn default() -> Self {
        Self { name: "quasi-static".to_owned(), settings: RollSettings::default() }
    }
}

impl EffectModel for Prior {
    fn name(&self) -> &str {
        &self.name
    }

    fn warnings(&self, _: &Scene, _: &ToolMotion) -> Vec<Warning> {
        Vec::new()
    }

    fn error_p95(&self) -> f64 {
        0.0
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_chunks(CHUNK)
            .map_init(
                || Roller::new(self.settings),
                |roller, chunk| roller.roll(scene, chunk, record, None),
            )
            .flatten_iter()
            .collect()
    }
}
