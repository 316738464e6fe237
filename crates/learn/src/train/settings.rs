//! Everything that decides a training run besides its data.

use pushplan::internals::network::Config;
use serde::{Deserialize, Serialize};

use super::{Descent, Noise};

/// Settings of a run; a checkpoint resumes only under the same ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Network size.
    pub config: Config,
    /// Seed of first weights, batches and noise.
    pub seed: u64,
    /// Optimiser steps of the whole schedule.
    pub steps: u64,
    /// Graphs per step. Large enough that two cores' halves keep the matrix products busy.
    pub batch: usize,
    /// Highest learning rate, reached after the warm-up.
    pub learning_rate: f64,
    /// Steps until the highest learning rate.
    pub warm_up: u64,
    /// Decoupled weight decay per unit learning rate.
    pub weight_decay: f64,
    /// Gradients are shortened to this norm.
    pub clip: f64,
    /// Share of the old average kept per step in the averaged weights, which are the ones
    /// evaluated and shipped.
    pub average: f64,
    /// Disturbance of input states.
    pub noise: Noise,
    /// Steps between held-out evaluations and checkpoints.
    pub evaluate_every: u64,
}

impl Settings {
    /// How weights follow gradients.
    pub fn descent(&self) -> Descent {
        let Self { steps, learning_rate, warm_up, weight_decay, clip, average, .. } = *self;
        Descent { steps, learning_rate, warm_up, weight_decay, clip, average }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            config: Config::default(),
            seed: 1,
            steps: 60_000,
            batch: 256,
            learning_rate: 2e-3,
            warm_up: 500,
            weight_decay: 1e-4,
            clip: 1.0,
            average: 0.999,
            noise: Noise::default(),
            evaluate_every: 2000,
        }
    }
}
