//! The gradient of a batch, differentiated in parts.

use pushplan::internals::network::Parameters;
use pushplan::internals::seeded::generator;
use rand::Rng;
use rayon::prelude::*;

use crate::train::TrainError;

use super::batch::Example;

/// A step's lever-ups are split into this many parts, differentiated in parallel and added in order,
/// so that the bits do not depend on the number of threads.
pub(super) const REPLICAS: usize = 2;

/// Mean loss and gradient over `count` examples, drawn by seed and step alone; `replica` says those
/// of a part.
pub(super) fn gradients(
    (seed, step): (u64, u64),
    examples: &[Example],
    count: usize,
    replica: impl Fn(&[&Example]) -> candle_core::Result<(f64, Parameters)> + Send + Sync,
) -> Result<(f64, Parameters), TrainError> {
    let mut rng = generator(seed, step);
    let drawn: Vec<&Example> =
        (0..count).map(|_| &examples[rng.random_range(0..examples.len())]).collect();
    let parts = drawn
        .par_chunks(count.div_ceil(REPLICAS).max(1))
        .map(replica)
        .collect::<Result<Vec<_>, candle_core::Error>>()?;
    Ok(mean_gradient(parts))
}

/// Means of losses and gradients of parts of a batch, added in order.
pub(super) fn mean_gradient(parts: Vec<(f64, Parameters)>) -> (f64, Parameters) {
    let share = 1.0 / parts.len() as f32;
    let mut total = 0.0;
    let mut sum = Parameters::default();
    for (loss, gradient) in parts {
        total += loss * f64::from(share);
        for (name, values) in gradient.values {
            let sum = sum.values.entry(name).or_insert_with(|| vec![0.0; values.len()]);
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += share * value);
        }
    }
    (total, sum)
}
