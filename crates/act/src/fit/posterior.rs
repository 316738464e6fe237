//! Posterior on a grid and its marginal estimates.

use serde::{Deserialize, Serialize};

use pushplan::scene::Span;

use super::grid::{Axis, Grid};

/// Width of a posterior, relative to the prior, from which on a parameter counts as unidentified.
const AS_WIDE: f64 = 0.6;

/// Probability of an interval.
const INTERVAL: f64 = 0.9;

/// Estimate of one parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Value with the maximum posterior probability.
    pub best: f64,
    /// Posterior mean.
    pub mean: f64,
    /// Posterior standard deviation.
    pub deviation: f64,
    /// Central interval with a probability of 0.9.
    pub interval: Span,
    /// Whether the recordings identify the parameter: the posterior standard deviation is less than
    /// 0.6 times the deviation of the uniform prior.
    pub identified: bool,
    /// Whether the best value is at the end of the prior range.
    pub at_the_end: bool,
}

/// Probabilities of the cells of a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Posterior {
    /// Grid of the cells.
    pub grid: Grid,
    /// Probability of every cell; the sum is one.
    pub probabilities: Vec<f64>,
}

impl Posterior {
    /// Creates a posterior from log-densities up to a constant.
    pub(super) fn of(grid: Grid, logs: &[f64]) -> Self {
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let weights: Vec<f64> = logs.iter().map(|log| (log - most).exp()).collect();
        let sum: f64 = weights.iter().sum();
        Self { grid, probabilities: weights.iter().map(|weight| weight / sum).collect() }
    }

    /// Returns the index of the most probable cell.
    pub fn best(&self) -> usize {
        let cells = self.probabilities.iter().enumerate();
        cells.max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(index, _)| index)
    }

    /// Returns spread and friction of the most probable cell.
    pub fn best_cell(&self) -> [f64; 2] {
        let (best, columns) = (self.best(), self.grid.friction.count);
        [self.grid.spread.at(best / columns), self.grid.friction.at(best % columns)]
    }

    /// Returns the estimate of the spread, whose prior is uniform over `prior`.
    pub(super) fn spread(&self, prior: Span) -> Estimate {
        let Grid { spread, friction } = self.grid;
        let of = |s| (0..friction.count).map(|f| self.probabilities[self.grid.index(s, f)]).sum();
        estimate(spread, (0..spread.count).map(of).collect(), self.best_cell()[0], prior)
    }

    /// Returns the estimate of the friction, whose prior is uniform over `prior`.
    pub(super) fn friction(&self, prior: Span) -> Estimate {
        let Grid { spread, friction } = self.grid;
        let of = |f| (0..spread.count).map(|s| self.probabilities[self.grid.index(s, f)]).sum();
        estimate(friction, (0..friction.count).map(of).collect(), self.best_cell()[1], prior)
    }
}

fn estimate(axis: Axis, shares: Vec<f64>, best: f64, prior: Span) -> Estimate {
    let mean: f64 = axis.values().zip(&shares).map(|(value, share)| value * share).sum();
    let variance: f64 =
        axis.values().zip(&shares).map(|(value, share)| share * (value - mean).powi(2)).sum();
    // Each value represents the interval of points nearest to it.
    let deviation = (variance + axis.step().powi(2) / 12.0).sqrt();
    let flat = (prior.high - prior.low) / 12f64.sqrt();
    let end = |end: f64| (best - end).abs() < 0.5 * axis.step();
    Estimate {
        best,
        mean,
        deviation,
        interval: Span::new(
            quantile(axis, &shares, 0.5 - INTERVAL / 2.0).max(prior.low),
            quantile(axis, &shares, 0.5 + INTERVAL / 2.0).min(prior.high),
        ),
        identified: deviation < AS_WIDE * flat,
        at_the_end: end(prior.low) || end(prior.high),
    }
}

/// Returns the quantile of a probability; each value's share is uniform around it.
fn quantile(axis: Axis, shares: &[f64], probability: f64) -> f64 {
    let mut below = 0.0;
    for (value, share) in axis.values().zip(shares) {
        if below + share >= probability && *share > 0.0 {
            return value + axis.step() * ((probability - below) / share - 0.5);
        }
        below += share;
    }
    axis.span.high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_normal_posterior_gives_its_mean_deviation_and_interval() {
        let grid = Grid {
            spread: Axis::over(Span::new(0.2, 1.0), 81),
            friction: Axis::over(Span::new(0.0, 1.0), 41),
        };
        let normal = |value: f64, mean: f64, width: f64| -0.5 * ((value - mean) / width).powi(2);
        let logs: Vec<f64> =
            grid.cells().map(|[k, mu]| normal(k, 0.6, 0.05) + normal(mu, 0.3, 0.1)).collect();
        let posterior = Posterior::of(grid, &logs);
        let spread = posterior.spread(Span::new(0.2, 1.0));
        assert!((spread.mean - 0.6).abs() < 1e-3 && (spread.best - 0.6).abs() < 1e-9, "{spread:?}");
        assert!((spread.deviation - 0.05).abs() < 1e-3 && spread.identified && !spread.at_the_end);
        assert!((spread.interval.low - (0.6 - 1.645 * 0.05)).abs() < 2e-3, "{spread:?}");
        assert!((spread.interval.high - (0.6 + 1.645 * 0.05)).abs() < 2e-3, "{spread:?}");
        let friction = posterior.friction(Span::new(0.0, 1.0));
        assert!((friction.mean - 0.3).abs() < 5e-3 && (friction.deviation - 0.1).abs() < 5e-3);
    }

    #[test]
    fn a_flat_posterior_has_no_information() {
        let prior = Span::new(0.2, 1.0);
        let grid =
            Grid { spread: Axis::over(prior, 21), friction: Axis::over(Span::new(0.0, 1.0), 21) };
        let posterior = Posterior::of(grid, &vec![0.0; grid.len()]);
        assert!(
            !posterior.spread(prior).identified
                && !posterior.friction(Span::new(0.0, 1.0)).identified
        );
    }
}
