//! Settings that determine a training run, except its episodes.

use pushplan::internals::network::Config;
use pushplan_learn::dataset::LeverConfig;
use pushplan_learn::train::Descent;
use serde::{Deserialize, Serialize};

/// Settings of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartsSettings {
    /// Size of the network.
    pub config: Config,
    /// Whether the network corrects the analytic model.
    pub prior: bool,
    /// Seed of initial weights and batches.
    pub seed: u64,
    /// Settings of the optimiser.
    pub descent: Descent,
    /// Families of the training set.
    pub data: Vec<LeverConfig>,
}

impl Default for PartsSettings {
    fn default() -> Self {
        Self {
            config: Config { width: 64, steps: 2 },
            prior: false,
            seed: 1,
            descent: Descent {
                steps: 20_000,
                batch: 128,
                evaluate_every: 1000,
                learning_rate: 3e-3,
                warm_up: 200,
                weight_decay: 0.02,
                clip: 1.0,
                average: 0.999,
            },
            data: Vec::new(),
        }
    }
}
