//! The network's estimate of its own error: contributions of single frames to the final error.
//!
//! The spread is learned from final errors. The spread of an object is a floor, a positive number
//! for each of its frames, and a share of the distance d between the readouts of two engines from
//! their mean: S = s + sum over t of length_t exp(w x_t + b) + a d. Here x_t is the even half of
//! the node's propagated state. The fit maximises the likelihood of errors of whole pushes that are
//! exponentially distributed around S.

use serde::{Deserialize, Serialize};

use crate::outcome::Spread;

use super::weights::WeightsError;

/// Maximum exponent of a frame: an error as long as the motion.
const LARGEST: f32 = 0.0;

/// Error estimator on hidden rows: for positions, and for headings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Doubt {
    /// Weights w, `[h]` each, to logarithms of errors relative to the length of the motion.
    pub weights: [Vec<f32>; 2],
    /// Biases b.
    pub bias: [f32; 2],
    /// Floors s of a moved object: metres, radians.
    pub floor: [f32; 2],
    /// Shares a of the distance between readouts.
    pub apart: [f32; 2],
}

impl Doubt {
    /// Returns the contribution of a frame with this hidden row, relative to its length.
    pub fn of_frame(&self, row: &[f32]) -> [f64; 2] {
        [0, 1].map(|k| {
            let exponent = dot(&self.weights[k], row) + self.bias[k];
            f64::from(exponent.min(LARGEST)).exp()
        })
    }

    /// Returns the constant contribution for a moved object.
    pub fn floor(&self) -> Spread {
        let [position, heading] = self.floor.map(f64::from);
        Spread { position, heading }
    }

    /// Checks that the estimator fits a network of half width `half` and that its numbers are
    /// sound.
    pub(super) fn check(&self, half: usize) -> Result<(), WeightsError> {
        let numbers = self.weights.iter().flatten().chain(&self.bias);
        let numbers = numbers.chain(&self.floor).chain(&self.apart);
        let sound = |value: &&f32| !(-1e3..=1e3).contains(*value);
        let value = match numbers.clone().find(sound) {
            Some(value) => f64::from(*value),
            None if self.weights.iter().all(|weights| weights.len() == half) => return Ok(()),
            None => self.weights[0].len() as f64,
        };
        Err(WeightsError::Value { name: "doubt".to_owned(), value, expected: "-1000 to 1000" })
    }
}

fn dot(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
