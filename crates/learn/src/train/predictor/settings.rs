//! Settings of a training run except its data.

use pushplan::internals::network::Config;
use serde::{Deserialize, Serialize};

use crate::train::Descent;

/// Settings of a run; the defaults are the settings of the shipped weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictorSettings {
    /// Network size.
    pub config: Config,
    /// Seed of initial weights and batches.
    pub seed: u64,
    /// Optimisation settings.
    pub descent: Descent,
}

impl Default for PredictorSettings {
    fn default() -> Self {
        Self {
            config: Config::default(),
            seed: 1,
            descent: Descent {
                steps: 5000,
                // Pushes, each of some ten graphs.
                batch: 128,
                evaluate_every: 500,
                learning_rate: 1e-3,
                warm_up: 500,
                weight_decay: 0.05,
                clip: 1.0,
                average: 0.999,
            },
        }
    }
}
