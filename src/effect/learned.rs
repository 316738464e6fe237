//! The learned effect model: the BRDPN physics predictor behind [`EffectModel`].

use rayon::prelude::*;

use crate::{
    brdpn::{Engine, Weights, Workspace},
    rollout::roll,
    scene::{Job, Record, Scene, ToolMotion, Trajectory, Warning},
};

use super::EffectModel;

/// Jobs that share a network batch: enough rows to keep the matrix products busy, few enough
/// that two cores share a coarse search evenly. Fixed, so that results do not depend on the
/// number of threads.
const CHUNK: usize = 32;

/// Predicts with trained weights.
pub struct Learned {
    name: String,
    engine: Engine,
    weights: Weights,
}

impl Learned {
    /// A model of these weights.
    pub fn new(weights: Weights) -> Self {
        let name = format!("brdpn-{}", weights.card.config.width);
        Self { name, engine: Engine::new(&weights), weights }
    }

    /// What the weights are.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }
}

impl EffectModel for Learned {
    fn name(&self) -> &str {
        &self.name
    }

    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
        self.weights.card.ranges.warnings(scene, motion)
    }

    fn error_p95(&self) -> f64 {
        self.weights.card.errors.p95
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_chunks(CHUNK)
            .map_init(Workspace::default, |workspace, chunk| {
                roll(scene, chunk, record, &mut |batch, corrections| {
                    self.engine.forward(batch, workspace, corrections);
                })
            })
            .flatten_iter()
            .collect()
    }
}

/// The quasi-static prior alone, without any network: the cheapest level with physics in it.
#[derive(Clone, Copy, Debug, Default)]
pub struct QuasiStatic;

impl EffectModel for QuasiStatic {
    fn name(&self) -> &str {
        "quasi-static"
    }

    fn warnings(&self, _: &Scene, _: &ToolMotion) -> Vec<Warning> {
        Vec::new()
    }

    fn error_p95(&self) -> f64 {
        0.0
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_chunks(CHUNK)
            .map(|chunk| {
                roll(scene, chunk, record, &mut |batch, corrections| {
                    corrections.clear();
                    corrections.resize(batch.node_count(), [0.0; 6]);
                })
            })
            .flatten_iter()
            .collect()
    }
}
