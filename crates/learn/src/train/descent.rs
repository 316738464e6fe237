//! How weights follow gradients.

use serde::{Deserialize, Serialize};

/// Schedule and regularisation of a run, whatever it trains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Descent {
    /// Optimiser steps of the whole schedule.
    pub steps: u64,
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
}
