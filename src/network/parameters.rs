//! Names, shapes and initial values of the physics predictor's parameters.
//!
//! Matrices are stored [in, out]: a transposed view costs up to four times at small batch.

use std::collections::BTreeMap;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::{Config, Tables};

/// Names and shapes of the parameters of a network, in the order of their use.
pub type Layout = Vec<(&'static str, Vec<usize>)>;

/// Parameter values by name, each row-major in the shape of [`layout`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters {
    /// Values by name.
    pub values: BTreeMap<String, Vec<f32>>,
}

/// Returns the parameters of the push network, see [`layout_of`].
pub fn layout(config: &Config) -> Layout {
    layout_of(&Tables::PUSHES, config)
}

/// Returns the names and shapes of all parameters, in the order of their use. h is half the width.
///
/// A matrix `[2, h, h]` acts on the even half and on the odd half separately. Biases `[h]` exist
/// for the even half only, because a constant cannot change sign under mirroring.
pub fn layout_of(tables: &Tables, config: &Config) -> Layout {
    let Tables { node, given, relation, output } = *tables;
    let h = config.half();
    let square = || vec![2, h, h];
    let given = match given {
        [0, 0] => Vec::new(),
        [even, odd] => vec![
            ("given.even", vec![even, h]),
            ("given.odd", vec![odd, h]),
            ("given.bias", vec![h]),
        ],
    };
    let others = [
        ("relation.even", vec![relation[0], h]),
        ("relation.odd", vec![relation[1], h]),
        ("relation.bias", vec![h]),
        ("relation.second", square()),
        ("relation.second_bias", vec![h]),
        ("object.even", vec![node[0], h]),
        ("object.odd", vec![node[1], h]),
        ("object.bias", vec![h]),
        ("object.second", square()),
        ("object.second_bias", vec![h]),
        ("message.relation", square()),
        ("message.receiver", square()),
        ("message.sender", square()),
        ("update.effect", square()),
        ("update.object", square()),
        ("update.own", square()),
        ("update.bias", vec![h]),
        ("motion.hidden", square()),
        ("motion.hidden_bias", vec![h]),
        ("motion.even", vec![h, output[0]]),
        ("motion.odd", vec![h, output[1]]),
    ];
    given.into_iter().chain(others).collect()
}

impl Parameters {
    /// Returns initial values of the push network, see [`Parameters::fresh_of`].
    pub fn fresh(config: &Config, seed: u64) -> Self {
        Self::fresh_of(&Tables::PUSHES, config, seed)
    }

    /// Returns random initial values from `seed`.
    ///
    /// Values are uniform with the variance 1 / fan-in, divided among the matrices that add up in
    /// one layer. Biases and the last layer are zero, so that an untrained network reproduces the
    /// analytic model exactly.
    pub fn fresh_of(tables: &Tables, config: &Config, seed: u64) -> Self {
        let mut random = Pcg64::seed_from_u64(seed);
        let values = layout_of(tables, config)
            .into_iter()
            .map(|(name, shape)| {
                let count: usize = shape.iter().product();
                let fan_in = shape[shape.len().saturating_sub(2)] as f32;
                let summed = match name {
                    n if n.starts_with("message") => 3.0,
                    n if n.starts_with("update") => 3.0,
                    _ => 1.0,
                };
                // The parity rectifier keeps half of the variance, like a ReLU.
                let bound = (2.0 * 3.0 / (fan_in * summed)).sqrt();
                let zero = shape.len() == 1 || name == "motion.even" || name == "motion.odd";
                let value = (0..count)
                    .map(|_| if zero { 0.0 } else { random.random_range(-bound..bound) })
                    .collect();
                (name.to_owned(), value)
            })
            .collect();
        Self { values }
    }

    /// Returns the number of parameters.
    pub fn count(&self) -> usize {
        self.values.values().map(Vec::len).sum()
    }
}
