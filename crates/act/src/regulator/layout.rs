//! Names and shapes of the belief regulator's parameters, and their initial values.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use pushplan::network::{Layout, Parameters};

/// Number of joint types, including *none*.
pub const TYPES: usize = 4;

/// Number of outputs per pair: a logit for every type, and the trust in the filter.
pub const OUTPUTS: usize = TYPES + 1;

/// Returns names and shapes of all parameters for F `features` and H `width`. Rows of three gates
/// have the order reset, update, candidate.
pub fn regulator_layout(features: usize, width: usize) -> Layout {
    vec![
        ("gates.input", vec![features, 3 * width]),
        ("gates.message", vec![width, 3 * width]),
        ("gates.hidden", vec![width, 3 * width]),
        ("gates.bias", vec![3 * width]),
        ("gates.candidate_bias", vec![width]),
        ("head.hidden", vec![width, width]),
        ("head.message", vec![width, width]),
        ("head.bias", vec![width]),
        ("head.logits", vec![width, OUTPUTS]),
        ("head.logits_bias", vec![OUTPUTS]),
    ]
}

/// Returns random initial values from `seed`: uniform with variance 1 / fan-in.
///
/// Biases and the output layer are zero, so an untrained regulator leaves the filter unchanged.
pub fn fresh_regulator(features: usize, width: usize, seed: u64) -> Parameters {
    let mut random = Pcg64::seed_from_u64(seed);
    let values = regulator_layout(features, width).into_iter().map(|(name, shape)| {
        let zero = shape.len() == 1 || name == "head.logits";
        // Matrices whose products are added share the variance.
        let bound = (3.0 / (2.0 * shape[0] as f32)).sqrt();
        let count: usize = shape.iter().product();
        let value = |_| if zero { 0.0 } else { random.random_range(-bound..bound) };
        (name.to_owned(), (0..count).map(value).collect())
    });
    Parameters { values: values.collect() }
}
