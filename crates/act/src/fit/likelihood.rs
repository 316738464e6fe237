//! Likelihood of distances under a noise law of unknown width.

use serde::{Deserialize, Serialize};

/// Degrees of freedom of Student's t distribution, whose tails cover pushes with bifurcating
/// outcomes (Lange, Little and Taylor 1989, doi:10.2307/2290063, use 4).
pub(super) const FREEDOM: f64 = 4.0;

/// Minimum width of the noise as a share of the mean motion.
///
/// Good models of equal physics differ by this much; a smaller width would make the posterior too
/// narrow.
pub(super) const DISAGREEMENT: f64 = 0.02;

/// Number of candidate widths, logarithmically spaced, and the largest in metres, if no width is
/// stated.
const WIDTHS: (usize, f64) = (64, 0.2);

/// Distribution of the part of a recorded end that a model cannot predict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NoiseLaw {
    /// Student's t distribution with four degrees of freedom, which allows outliers.
    #[default]
    Student,
    /// Normal distribution.
    Gaussian,
}

/// Final residual of an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Residual {
    /// Distance, including the rotation at the radius of gyration if the heading is known, metres.
    pub distance: f64,
    /// Number of components: 2, or 3 with a heading.
    pub numbers: f64,
}

impl NoiseLaw {
    /// Returns the log-density of `residuals` at a `width` in metres, up to a constant.
    fn log_density(self, residuals: &[Residual], width: f64) -> f64 {
        let one = |residual: &Residual| {
            let square = (residual.distance / width).powi(2);
            let spread = match self {
                NoiseLaw::Gaussian => 0.5 * square,
                NoiseLaw::Student => {
                    0.5 * (FREEDOM + residual.numbers) * (square / FREEDOM).ln_1p()
                }
            };
            -residual.numbers * width.ln() - spread
        };
        residuals.iter().map(one).sum()
    }
}

/// Candidate widths of the noise with equal prior probabilities.
#[derive(Clone, Debug)]
pub(super) struct Widths(Vec<f64>);

impl Widths {
    /// Returns the stated width alone, metres, otherwise a range for objects with this mean motion.
    pub fn of(stated: Option<f64>, motion: f64) -> Self {
        let (count, high) = WIDTHS;
        let low = (DISAGREEMENT * motion).min(high);
        let width = |k| low * (high / low).powf(k as f64 / (count - 1) as f64);
        Self(stated.map_or_else(|| (0..count).map(width).collect(), |width| vec![width]))
    }

    /// Returns the log-density of `residuals` over all widths and the posterior mean width.
    pub fn log_density(&self, law: NoiseLaw, residuals: &[Residual]) -> (f64, f64) {
        let logs: Vec<f64> =
            self.0.iter().map(|&width| law.log_density(residuals, width)).collect();
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let weights: Vec<f64> = logs.iter().map(|log| (log - most).exp()).collect();
        let sum: f64 = weights.iter().sum();
        let mean = self.0.iter().zip(&weights).map(|(width, weight)| width * weight).sum::<f64>();
        (most + sum.ln(), mean / sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_width_found_is_that_of_the_residuals() {
        // The mean of the sum of three squared normal numbers of width s is 3 s^2.
        let far = 3f64.sqrt() * 2e-3;
        let residuals = vec![Residual { distance: far, numbers: 3.0 }; 400];
        let (_, width) = Widths::of(None, 0.01).log_density(NoiseLaw::Gaussian, &residuals);
        assert!((width / 2e-3 - 1.0).abs() < 0.05, "{width}");
    }

    #[test]
    fn one_push_far_off_hardly_moves_students_law() {
        let residual = |distance| Residual { distance, numbers: 2.0 };
        let near = vec![residual(1e-3); 20];
        let far = [&near[..], &[residual(0.05)]].concat();
        let width =
            |law, residuals: &[Residual]| Widths::of(None, 0.01).log_density(law, residuals).1;
        let grows = |law| width(law, &far) / width(law, &near);
        assert!(grows(NoiseLaw::Student) < 1.3 && grows(NoiseLaw::Gaussian) > 5.0);
    }
}
