//! Settings of a regulator's training except its lessons.

use serde::{Deserialize, Serialize};

use crate::train::Descent;

/// Settings of a run; the defaults are the settings of the shipped weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegulatorSettings {
    /// Width of the hidden state, H.
    pub width: usize,
    /// Seed of initial weights and batches.
    pub seed: u64,
    /// Optimisation settings.
    pub descent: Descent,
    /// Seed of the lessons.
    pub data_seed: u64,
    /// Number of lessons.
    pub lessons: u64,
}

impl Default for RegulatorSettings {
    fn default() -> Self {
        Self {
            width: 64,
            seed: 1,
            descent: Descent {
                steps: 3000,
                batch: 16,
                evaluate_every: 250,
                learning_rate: 2e-3,
                warm_up: 200,
                // A few thousand lessons are few for the regulator's parameters.
                weight_decay: 0.02,
                clip: 1.0,
                average: 0.995,
            },
            data_seed: 1,
            lessons: 2500,
        }
    }
}
