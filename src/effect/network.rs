//! The network as an effect model: the BRDPN physics predictor corrects the prior.

use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::{
    network::{Buffers, Forward, Weights},
    rollout::{RollSettings, Roller, Work, reachable},
    scene::{FRAME_TRAVEL, Job, Record, Scene, ToolMotion, Trajectory, Warning},
};

use super::EffectModel;

/// Jobs that share a network batch: enough rows to keep the matrix products busy, few enough
/// that two cores share a coarse search evenly. Fixed, so that results do not depend on the
/// number of threads.
pub(super) const CHUNK: usize = 32;

/// Predicts with trained weights.
pub struct Network {
    name: String,
    forward: Forward,
    weights: Weights,
    settings: RollSettings,
    error_p95: f64,
}

impl Network {
    /// A model of these weights.
    pub fn new(weights: Weights) -> Self {
        let name = format!("brdpn-{}", weights.card.config.width);
        let error_p95 = weights.card.errors.as_ref().map_or(f64::INFINITY, |errors| errors.p95);
        let forward = Forward::new(&weights);
        Self { name, forward, weights, settings: RollSettings::default(), error_p95 }
    }

    /// The same with `stride` frames predicted as one. Measured errors are those of stride 1;
    /// that of any other is unknown.
    pub fn with_stride(mut self, stride: usize) -> Self {
        self.settings.stride = stride.max(1);
        self.error_p95 = f64::INFINITY;
        self.name += &stride_name(stride);
        self
    }

    /// The same with `steps` propagation steps, whatever it was trained with; its error is
    /// unknown then.
    pub fn with_steps(mut self, steps: usize) -> Self {
        self.forward = self.forward.with_steps(steps);
        self.error_p95 = f64::INFINITY;
        let plural = if steps == 1 { "" } else { "s" };
        self.name += &format!(", {steps} step{plural}");
        self
    }

    /// The same under another name.
    pub fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    /// The same model with every body looked at in every frame, whether it can matter or not:
    /// the same results, to see what leaving them out saves.
    pub fn unpruned(mut self) -> Self {
        self.settings.pruned = false;
        self.name += ", unpruned";
        self
    }

    /// What the weights are.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// [`EffectModel::rollout`] on this thread, jobs in one batch, and how much of the time
    /// went to the network; the rest is geometry, prior, features and integration.
    pub fn timed_rollout(&self, scene: &Scene, jobs: &[Job]) -> (Vec<Trajectory>, Duration) {
        let (mut buffers, mut network) = (Buffers::default(), Duration::ZERO);
        let mut roller = Roller::new(self.settings);
        let trajectories = jobs.chunks(CHUNK).flat_map(|chunk| {
            roller.roll(
                scene,
                chunk,
                Record::Outcome,
                Some(&mut |batch, corrections| {
                    let began = Instant::now();
                    self.forward.run(batch, &mut buffers, corrections);
                    network += began.elapsed();
                }),
            )
        });
        let trajectories = trajectories.collect();
        (trajectories, network)
    }

    /// What rolling `jobs` out takes: frames, graphs, nodes.
    pub fn work(&self, scene: &Scene, jobs: &[Job]) -> Work {
        let (mut roller, mut buffers) = (Roller::new(self.settings), Buffers::default());
        for chunk in jobs.chunks(CHUNK) {
            roller.roll(
                scene,
                chunk,
                Record::Outcome,
                Some(&mut |batch, corrections| {
                    self.forward.run(batch, &mut buffers, corrections);
                }),
            );
        }
        *roller.work()
    }
}

impl EffectModel for Network {
    fn name(&self) -> &str {
        &self.name
    }

    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
        let ranges = &self.weights.card.ranges;
        let found = ranges.warnings(scene, motion);
        if found.is_empty() {
            return found;
        }
        // What the motion cannot reach is never shown to the network.
        let reached = reachable(scene, &Job::stated(scene, motion.clone()));
        ranges.warnings(&scene.only(&reached), motion)
    }

    fn error_p95(&self) -> f64 {
        self.error_p95
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_chunks(CHUNK)
            .map_init(
                || (Roller::new(self.settings), Buffers::default()),
                |(roller, buffers), chunk| {
                    roller.roll(
                        scene,
                        chunk,
                        record,
                        Some(&mut |batch, corrections| {
                            self.forward.run(batch, buffers, corrections);
                        }),
                    )
                },
            )
            .flatten_iter()
            .collect()
    }
}

/// What a stride adds to a name: the tool's travel in a frame.
pub(super) fn stride_name(stride: usize) -> String {
    format!(", {:.0} mm frames", 1e3 * FRAME_TRAVEL * stride as f64)
}
