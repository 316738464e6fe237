//! Optimisation settings and learning rate schedule of a run.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

/// Final learning rate as a share of the maximum.
const FLOOR: f64 = 0.005;

/// Schedule and regularisation of a run, independent of the network.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Descent {
    /// Number of optimiser steps of the whole schedule.
    pub steps: u64,
    /// Number of examples per step over both replicas, an even number.
    pub batch: usize,
    /// Number of steps between held-out evaluations and checkpoints.
    pub evaluate_every: u64,
    /// Maximum learning rate, reached after the warm-up.
    pub learning_rate: f64,
    /// Number of warm-up steps.
    pub warm_up: u64,
    /// Decoupled weight decay per unit learning rate.
    pub weight_decay: f64,
    /// Maximum norm of the gradient; larger gradients are scaled down.
    pub clip: f64,
    /// Share of the old average kept per step in the averaged weights, which are evaluated and
    /// shipped.
    pub average: f64,
}

impl Descent {
    /// Returns the schedule with other `steps`, and a warm-up of at most a tenth of them.
    #[must_use]
    pub fn in_steps(self, steps: u64) -> Self {
        Self { steps, warm_up: self.warm_up.min(steps / 10), ..self }
    }

    /// Returns the learning rate of a step: linear warm-up, then half a cosine down to `FLOOR`
    /// (Loshchilov and Hutter 2017).
    pub fn learning_rate(&self, step: u64) -> f64 {
        let peak = self.learning_rate;
        if step < self.warm_up {
            return peak * (step + 1) as f64 / self.warm_up as f64;
        }
        let span = self.steps.saturating_sub(self.warm_up).max(1) as f64;
        let done = ((step - self.warm_up) as f64 / span).min(1.0);
        peak * (FLOOR + (1.0 - FLOOR) * 0.5 * (1.0 + (PI * done).cos()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::PredictorSettings;

    #[test]
    fn it_rises_then_falls_to_the_floor() {
        let descent = PredictorSettings::default().descent;
        let at = |step| descent.learning_rate(step);
        assert!(at(0) < at(250) && at(250) < at(500));
        assert!((at(500) - descent.learning_rate).abs() < 1e-9);
        assert!((at(descent.steps) - FLOOR * descent.learning_rate).abs() < 1e-12);
    }
}
