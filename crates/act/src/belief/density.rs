//! Logarithms of probability densities.

use nalgebra::{DMatrix, DVector};

/// Degrees of freedom of Student's t distribution, which allows occasional observations far from
/// every hypothesis.
const FREEDOM: f64 = 4.0;

/// Returns the logarithm of the density of Student's t distribution at `off` with scale matrix
/// `spread`.
///
/// A constant that depends only on the dimension is omitted. Returns minus infinity if `spread` is
/// not positive definite.
pub(super) fn student(off: &DVector<f64>, spread: DMatrix<f64>) -> f64 {
    let n = off.len() as f64;
    let Some(factor) = spread.cholesky() else { return f64::NEG_INFINITY };
    let volume: f64 = factor.l_dirty().diagonal().iter().map(|side| side.ln()).sum();
    let square = off.dot(&factor.solve(off));
    -volume - 0.5 * (FREEDOM + n) * (square / FREEDOM).ln_1p()
}

/// Returns the logarithm of the density of Student's t distribution of one number with the squared
/// scale `variance`.
pub(super) fn student_of_one(off: f64, variance: f64) -> f64 {
    // Logarithm of the density at zero, with four degrees of freedom.
    let most = 0.375f64.ln() - 0.5 * variance.ln();
    most - 0.5 * (FREEDOM + 1.0) * (off * off / variance / FREEDOM).ln_1p()
}

/// Returns the logarithm of the sum of the exponentials of `logs`.
pub(super) fn log_sum(logs: impl Iterator<Item = f64> + Clone) -> f64 {
    let most = logs.clone().fold(f64::NEG_INFINITY, f64::max);
    if most == f64::NEG_INFINITY {
        return most;
    }
    most + logs.map(|log| (log - most).exp()).sum::<f64>().ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_number_follows_students_law() {
        let log = |x: f64, s: f64| {
            student(&DVector::from_element(1, x), DMatrix::from_element(1, 1, s * s))
        };
        // Density with four degrees of freedom: 3/8 (1 + x^2/4)^(-5/2).
        let density = |x: f64| 0.375 * (1.0 + 0.25 * x * x).powf(-2.5);
        for x in [0.3, 1.0, 4.0] {
            let wanted = (density(x / 2.0) / density(0.0)).ln();
            assert!((log(x, 2.0) - log(0.0, 2.0) - wanted).abs() < 1e-12);
            assert!((student_of_one(x, 4.0) - (0.5 * density(x / 2.0)).ln()).abs() < 1e-12);
        }
        assert!(
            (log(0.0, 1.0) - log(0.0, 2.0) - 2f64.ln()).abs() < 1e-12,
            "twice as wide, half as high"
        );
    }

    #[test]
    fn sums_of_logarithms_do_not_overflow() {
        assert!((log_sum([-1000.0, -1000.0].into_iter()) + 1000.0 - 2f64.ln()).abs() < 1e-12);
        assert_eq!(log_sum([].into_iter()), f64::NEG_INFINITY);
    }
}
