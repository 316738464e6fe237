//! Distributions used for sampling.

use std::f64::consts::TAU;

use pushplan::internals::scene::Span;
pub(super) use pushplan_act::belief::weighted;
use rand::Rng;
use rand_pcg::Pcg64;

/// Draws a number uniformly from an interval.
pub(super) fn uniform(rng: &mut Pcg64, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.random::<f64>()
}

/// Draws a log-uniform number, so that every decade is equally probable.
pub fn log_uniform(rng: &mut Pcg64, span: Span) -> f64 {
    uniform(rng, span.low.ln(), span.high.ln()).exp().clamp(span.low, span.high)
}

/// Draws a heading uniformly over the full turn, radians.
pub(super) fn heading(rng: &mut Pcg64) -> f64 {
    uniform(rng, 0.0, TAU)
}

/// Draws -1 or 1.
pub(super) fn sign(rng: &mut Pcg64) -> f64 {
    if rng.random::<bool>() { 1.0 } else { -1.0 }
}
