//! Assumptions of a belief.

use serde::{Deserialize, Serialize};

use pushplan::task::Noise;

/// Assumptions about observations and about the accuracy of the effect model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefSettings {
    /// Noise of the observations.
    pub noise: Noise,
    /// Exponent of the likelihoods. Successive windows share the model's errors, so full weight
    /// would make the belief overconfident.
    pub tempering: f64,
}

impl BeliefSettings {
    /// Creates the settings for observations with this noise.
    pub fn new(noise: Noise) -> Self {
        Self { noise, tempering: 0.2 }
    }
}
