//! How far off the network expects to be: what every frame adds to the error at the end.
//!
//! Errors of single frames say little of the error of a whole push, as most of them undo each other.
//! So the spread is learned of ends: that of an object is a floor plus a positive number for each of
//! its frames, S = s + sum over t of exp(w x_t + b), with x_t the even half of the hidden row that
//! corrections are read from. It is fitted by maximum likelihood with errors of whole pushes taken
//! as exponentially distributed around S.

use serde::{Deserialize, Serialize};

use crate::outcome::Spread;

use super::weights::WeightsError;

/// Largest exponent of a frame: e^4 output units are half a metre.
const LARGEST: f32 = 4.0;

/// What is read from hidden rows: for positions, and for headings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Doubt {
    /// w, `[h]` each, to logarithms of output units.
    pub weights: [Vec<f32>; 2],
    /// b.
    pub bias: [f32; 2],
    /// s, of an object that was moved: metres, radians.
    pub floor: [f32; 2],
}

impl Doubt {
    /// What a frame with this hidden row adds.
    pub fn of_frame(&self, row: &[f32]) -> [f64; 2] {
        [0, 1].map(|k| {
            let exponent = dot(&self.weights[k], row) + self.bias[k];
            f64::from(exponent.min(LARGEST)).exp()
        })
    }

    /// What is added once for an object that was moved.
    pub fn floor(&self) -> Spread {
        let [position, heading] = self.floor.map(f64::from);
        Spread { position, heading }
    }

    /// Whether it is of a network whose half is `half` wide, and of sound numbers.
    pub(super) fn check(&self, half: usize) -> Result<(), WeightsError> {
        let numbers = self.weights.iter().flatten().chain(&self.bias).chain(&self.floor);
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
