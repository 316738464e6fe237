//! Seeded random numbers and approximations of the normal distribution.

use std::f64::consts::TAU;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Factor for which the logistic function of the scaled number is within 0.01 of the normal
/// distribution function (Bowling et al. 2009, doi:10.3926/jiem.2009.v2n1.p114-127).
pub(super) const LOGISTIC: f64 = 1.702;

/// Returns the generator of draw `index` under `seed`.
pub fn generator(seed: u64, index: u64) -> Pcg64 {
    // An odd factor keeps indices apart; the seeding mixes the bits.
    Pcg64::seed_from_u64(seed ^ index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15))
}

/// Draws a standard normal number (Box and Muller 1958, doi:10.1214/aoms/1177706645).
pub fn normal(rng: &mut impl Rng) -> f64 {
    // The argument is in (0, 1], so its logarithm is finite.
    let radius = (-2.0 * (1.0 - rng.random::<f64>()).ln()).sqrt();
    radius * (TAU * rng.random::<f64>()).cos()
}

/// Draws an index with these weights, which need not sum to one.
pub fn weighted(rng: &mut impl Rng, weights: &[f64]) -> usize {
    let mut left = rng.random::<f64>() * weights.iter().sum::<f64>();
    for (index, weight) in weights.iter().enumerate() {
        left -= weight;
        if left < 0.0 {
            return index;
        }
    }
    weights.len().saturating_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_mean_nought_and_variance_one() {
        let mut rng = generator(3, 5);
        let drawn: Vec<f64> = (0..20_000).map(|_| normal(&mut rng)).collect();
        let mean = drawn.iter().sum::<f64>() / drawn.len() as f64;
        let square = drawn.iter().map(|x| x * x).sum::<f64>() / drawn.len() as f64;
        assert!(mean.abs() < 0.03 && (square - 1.0).abs() < 0.05, "{mean} {square}");
    }

    #[test]
    fn indices_come_as_often_as_they_weigh() {
        let mut rng = generator(1, 0);
        let ones = (0..4000).filter(|_| weighted(&mut rng, &[1.0, 3.0]) == 1).count();
        assert!((2900..3100).contains(&ones), "{ones}");
        assert_eq!(weighted(&mut rng, &[]), 0);
    }
}
