//! Seeded random numbers: one generator for each episode, and the few draws that sampling needs.

use std::f64::consts::TAU;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::scene::Span;

/// The generator of item `index` under `seed`, the same however many items are drawn, in
/// whatever order and on whichever thread.
pub fn generator(seed: u64, index: u64) -> Pcg64 {
    Pcg64::seed_from_u64(mix(mix(seed).wrapping_add(index)))
}

/// Uniform in the interval.
pub(super) fn uniform(rng: &mut Pcg64, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.random::<f64>()
}

/// Uniform in the logarithm, so that every decade is drawn equally often.
pub fn log_uniform(rng: &mut Pcg64, span: Span) -> f64 {
    uniform(rng, span.low.ln(), span.high.ln()).exp().clamp(span.low, span.high)
}

/// A heading, uniform over the full turn, radians.
pub(super) fn heading(rng: &mut Pcg64) -> f64 {
    uniform(rng, 0.0, TAU)
}

/// -1 or 1.
pub(super) fn sign(rng: &mut Pcg64) -> f64 {
    if rng.random::<bool>() { 1.0 } else { -1.0 }
}

/// An index drawn with the given weights.
pub(super) fn weighted(rng: &mut Pcg64, weights: &[f64]) -> usize {
    let mut left = rng.random::<f64>() * weights.iter().sum::<f64>();
    for (index, weight) in weights.iter().enumerate() {
        left -= weight;
        if left < 0.0 {
            return index;
        }
    }
    weights.len().saturating_sub(1)
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014, doi:10.1145/2660193.2660195):
/// neighbouring indices give unrelated generators.
fn mix(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
