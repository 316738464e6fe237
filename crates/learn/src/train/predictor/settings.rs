//! Everything that decides a training run besides its data.

use pushplan::internals::network::Config;
use serde::{Deserialize, Serialize};

use crate::train::Descent;

use super::Noise;

/// Settings of a run; the defaults are those of the shipped weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictorSettings {
    /// Network size.
    pub config: Config,
    /// Seed of first weights, batches and noise.
    pub seed: u64,
    /// How weights follow gradients.
    pub descent: Descent,
    /// Disturbance of input states.
    pub noise: Noise,
}

impl Default for PredictorSettings {
    fn default() -> Self {
        Self {
            config: Config::default(),
            seed: 1,
            descent: Descent {
                steps: 3000,
                // Large enough that two cores' halves keep the matrix products busy.
                batch: 256,
                evaluate_every: 500,
                learning_rate: 1e-3,
                warm_up: 500,
                weight_decay: 1e-4,
                clip: 1.0,
                average: 0.999,
            },
            noise: Noise::default(),
        }
    }
}
