//! AdamW with gradient clipping and a running average of the weights.
//!
//! Adam (Kingma and Ba 2015) with decoupled weight decay (Loshchilov and Hutter 2019). candle's
//! implementation keeps its moments private, which prevents resumption.

use pushplan::internals::network::Parameters;

use super::Descent;

const BETA1: f32 = 0.9;
/// Shorter memory than the usual 0.999 because runs are short and early gradients change quickly.
const BETA2: f32 = 0.99;
const EPSILON: f32 = 1e-8;

/// Weights, their moments and their average.
#[derive(Clone, Debug, PartialEq)]
pub struct AdamW {
    /// Current weights.
    pub weights: Parameters,
    /// First moments.
    pub first: Parameters,
    /// Second moments.
    pub second: Parameters,
    /// Averaged weights, which are evaluated and shipped.
    pub average: Parameters,
    /// Number of steps taken.
    pub step: u64,
}

impl AdamW {
    /// Creates an optimiser at `weights`.
    pub fn new(weights: Parameters) -> Self {
        let mut zero = weights.clone();
        for values in zero.values.values_mut() {
            values.fill(0.0);
        }
        Self { average: weights.clone(), first: zero.clone(), second: zero, weights, step: 0 }
    }

    /// Takes one step along `gradients`, which must have the weights' names and lengths.
    ///
    /// Returns the gradient's norm before clipping. A non-finite norm leaves the weights unchanged.
    pub fn update(&mut self, descent: &Descent, gradients: &Parameters) -> f64 {
        let square: f64 =
            gradients.values.values().flatten().map(|&g| f64::from(g) * f64::from(g)).sum();
        let norm = square.sqrt();
        if !norm.is_finite() {
            return norm;
        }
        let shorten = (descent.clip / norm.max(1e-12)).min(1.0) as f32;
        let rate = descent.learning_rate(self.step) as f32;
        self.step += 1;
        let t = self.step as i32;
        let (bias1, bias2) = (1.0 - BETA1.powi(t), 1.0 - BETA2.powi(t));
        // A young average forgets faster, so that the initial weights lose their influence.
        let keep = descent.average.min((1.0 + t as f64) / (10.0 + t as f64)) as f32;
        for (name, gradient) in &gradients.values {
            // Biases are not decayed.
            let decay = if name.contains("bias") { 0.0 } else { descent.weight_decay as f32 };
            let (Some(w), Some(m), Some(v), Some(a)) = (
                self.weights.values.get_mut(name),
                self.first.values.get_mut(name),
                self.second.values.get_mut(name),
                self.average.values.get_mut(name),
            ) else {
                continue;
            };
            for k in 0..gradient.len() {
                let g = gradient[k] * shorten;
                m[k] = BETA1 * m[k] + (1.0 - BETA1) * g;
                v[k] = BETA2 * v[k] + (1.0 - BETA2) * g * g;
                let change = (m[k] / bias1) / ((v[k] / bias2).sqrt() + EPSILON);
                w[k] -= rate * (change + decay * w[k]);
                a[k] = keep * a[k] + (1.0 - keep) * w[k];
            }
        }
        norm
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::PredictorSettings;

    fn one(value: f32) -> Parameters {
        Parameters { values: [("x".to_owned(), vec![value])].into() }
    }

    #[test]
    fn the_first_step_has_the_length_of_the_learning_rate() {
        // With bias-corrected moments, Adam's first change is the sign of the gradient.
        let descent =
            Descent { weight_decay: 0.0, warm_up: 0, ..PredictorSettings::default().descent };
        let mut adam = AdamW::new(one(1.0));
        let norm = adam.update(&descent, &one(0.25));
        assert!((norm - 0.25).abs() < 1e-12);
        let moved = 1.0 - adam.weights.values["x"][0];
        assert!((f64::from(moved) - descent.learning_rate).abs() < 1e-6);
    }

    #[test]
    fn a_gradient_that_is_not_finite_changes_nothing() {
        let mut adam = AdamW::new(one(1.0));
        let before = adam.clone();
        assert!(adam.update(&PredictorSettings::default().descent, &one(f32::NAN)).is_nan());
        assert_eq!(adam, before);
    }
}
