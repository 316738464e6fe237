//! What a belief assumes.

use serde::{Deserialize, Serialize};

use pushplan::task::Noise;

/// What a belief assumes of what it sees, and how much it trusts the effect model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefSettings {
    /// Errors of what is seen.
    pub noise: Noise,
    /// Share of the evidence that counts. Windows that follow each other share the model's errors, so
    /// that all of it would make the belief surer than it is right.
    pub tempering: f64,
}

impl BeliefSettings {
    /// For observations with such errors.
    pub fn new(noise: Noise) -> Self {
        Self { noise, tempering: 0.2 }
    }
}
