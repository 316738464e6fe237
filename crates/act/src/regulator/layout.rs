//! Parameters of the belief regulator by name and shape, and their first values.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use pushplan::network::{Layout, Parameters};

/// Types of joints, *none* among them.
pub const TYPES: usize = 4;

/// What the network says of a pair: a logit for every type, and how far the filter is to be trusted.
pub const OUTPUTS: usize = TYPES + 1;

/// Names and shapes of all parameters for F `features` and H `width`. Of every row of three gates the
/// order is reset, update, candidate.
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

/// Random first values from `seed`: uniform with the variance 1 / fan-in; biases and what gives the
/// outputs are zero, so that an untrained regulator leaves the filter as it is.
pub fn fresh_regulator(features: usize, width: usize, seed: u64) -> Parameters {
    let mut random = Pcg64::seed_from_u64(seed);
    let values = regulator_layout(features, width).into_iter().map(|(name, shape)| {
        let zero = shape.len() == 1 || name == "head.logits";
        // Of matrices whose products add up every one has its share.
        let bound = (3.0 / (2.0 * shape[0] as f32)).sqrt();
        let count: usize = shape.iter().product();
        let value = |_| if zero { 0.0 } else { random.random_range(-bound..bound) };
        (name.to_owned(), (0..count).map(value).collect())
    });
    Parameters { values: values.collect() }
}
