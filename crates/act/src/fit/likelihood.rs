//! How likely a set of distances is under a law of noise of unknown width.

use serde::{Deserialize, Serialize};

/// Degrees of freedom of Student's law: pushes that fork are no rarer than it says (Lange, Little
/// and Taylor 1989, doi:10.2307/2290063, take 4).
pub(super) const FREEDOM: f64 = 4.0;

/// Noise is never taken as smaller than this share of the mean motion: even good models of the same
/// physics end this far apart, and a posterior that trusts them more is narrower than it should be.
pub(super) const DISAGREEMENT: f64 = 0.02;

/// Widths that are tried where none is stated: how many, and the largest in metres; they are
/// evenly spaced in their logarithm.
const WIDTHS: (usize, f64) = (64, 0.2);

/// The law of the part of a recorded end that a model cannot know.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NoiseLaw {
    /// Student's with four degrees of freedom: a few pushes may end far off.
    #[default]
    Student,
    /// The normal law.
    Gaussian,
}

/// How far an object ends from where it was recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Residual {
    /// Distance, with the turn at the object's radius of gyration if its heading is known, metres.
    pub distance: f64,
    /// Numbers behind it: 2, or 3 with a heading.
    pub numbers: f64,
}

impl NoiseLaw {
    /// Logarithm of the density of `residuals` at a `width` in metres, up to a constant.
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

/// Widths of the noise that are thought possible, each as likely as the others.
#[derive(Clone, Debug)]
pub(super) struct Widths(Vec<f64>);

impl Widths {
    /// The stated one alone, metres, or whatever the residuals of objects show that move so far.
    pub fn of(stated: Option<f64>, motion: f64) -> Self {
        let (count, high) = WIDTHS;
        let low = (DISAGREEMENT * motion).min(high);
        let width = |k| low * (high / low).powf(k as f64 / (count - 1) as f64);
        Self(stated.map_or_else(|| (0..count).map(width).collect(), |width| vec![width]))
    }

    /// Logarithm of the density of `residuals` over all widths, and the mean width behind it.
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
        // Squares of three normal numbers of width s have the mean 3 s^2.
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
