//! Means and percentiles with confidence intervals.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use pushplan::scene::Span;

/// Number of bootstrap resamples; the ends of a 95 % interval are then the 25th of a thousand.
const RESAMPLES: usize = 1000;

/// Summary of a list of numbers, in their unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Number of values.
    pub count: usize,
    /// Arithmetic mean.
    pub mean: f64,
    /// 95 % bootstrap interval of the mean.
    pub mean_interval: Span,
    /// Median.
    pub median: f64,
    /// 90th percentile.
    pub p90: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Maximum.
    pub max: f64,
}

impl Summary {
    /// Summarises `values`; `None` for an empty list or one with a non-finite value.
    pub fn of(values: &[f64]) -> Option<Self> {
        if values.is_empty() || values.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        Some(Self {
            count: sorted.len(),
            mean: mean(&sorted),
            mean_interval: mean_interval(&sorted),
            median: percentile(&sorted, 50.0),
            p90: percentile(&sorted, 90.0),
            p95: percentile(&sorted, 95.0),
            max: percentile(&sorted, 100.0),
        })
    }

    /// Returns the summary in another unit, with each value multiplied by a positive `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        let interval = Span::new(self.mean_interval.low * factor, self.mean_interval.high * factor);
        Self {
            count: self.count,
            mean: self.mean * factor,
            mean_interval: interval,
            median: self.median * factor,
            p90: self.p90 * factor,
            p95: self.p95 * factor,
            max: self.max * factor,
        }
    }
}

/// Position errors of objects relative to their true displacement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RelativeErrors {
    /// Number of objects.
    pub objects: usize,
    /// Mean distance from the start to the true positions, metres.
    pub motion: f64,
    /// Mean distance from the true to the predicted positions, metres.
    pub mean: f64,
    /// Median error over objects, metres.
    pub median: f64,
    /// 90th percentile of the error over objects, metres.
    pub p90: f64,
    /// 95th percentile of the error over objects, metres.
    pub p95: f64,
    /// Mean error as a share of the mean motion.
    pub relative: f64,
    /// 95 % interval of `relative`, by bootstrap over trials because the objects of a trial are
    /// correlated.
    pub relative_interval: Span,
}

impl RelativeErrors {
    /// Computes the errors from pairs of error and displacement, trial by trial; `None` without
    /// pairs.
    pub fn of(trials: &[Vec<[f64; 2]>]) -> Option<Self> {
        let mut sorted: Vec<f64> = trials.iter().flatten().map(|pair| pair[0]).collect();
        if sorted.is_empty() {
            return None;
        }
        sorted.sort_by(f64::total_cmp);
        let motions: Vec<f64> = trials.iter().flatten().map(|pair| pair[1]).collect();
        let (error, motion) = (mean(&sorted), mean(&motions));
        let add = |sum: [f64; 2], pair: &[f64; 2]| [sum[0] + pair[0], sum[1] + pair[1]];
        let sums: Vec<[f64; 2]> =
            trials.iter().map(|pairs| pairs.iter().fold([0.0; 2], add)).collect();
        Some(Self {
            objects: sorted.len(),
            motion,
            mean: error,
            median: percentile(&sorted, 50.0),
            p90: percentile(&sorted, 90.0),
            p95: percentile(&sorted, 95.0),
            relative: ratio([error, motion]),
            relative_interval: interval(sums.len(), |draw| {
                ratio(draw.fold([0.0; 2], |sum, k| add(sum, &sums[k])))
            }),
        })
    }

    /// Returns a length in metres as a share of the mean displacement.
    pub fn share(&self, metres: f64) -> f64 {
        metres / self.motion.max(f64::MIN_POSITIVE)
    }
}

/// Returns the arithmetic mean; 0 for an empty list.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Returns the `p`-th percentile, 0 to 100, of an ascending list; 0 for an empty list.
///
/// The result is interpolated linearly between order statistics at ranks 0 to n - 1 (type 7 of
/// Hyndman and Fan 1996, doi:10.2307/2684934).
pub fn percentile(sorted: &[f64], p: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let rank = (p / 100.0).clamp(0.0, 1.0) * last as f64;
    let below = rank.floor() as usize;
    let above = (below + 1).min(last);
    sorted[below] + (sorted[above] - sorted[below]) * (rank - below as f64)
}

/// Returns the 95 % interval of the mean.
fn mean_interval(values: &[f64]) -> Span {
    interval(values.len(), |draw| draw.map(|k| values[k]).sum::<f64>() / values.len() as f64)
}

/// Returns the 95 % interval of a statistic of `count` independent items.
///
/// Computed by the percentile bootstrap (Efron 1979, doi:10.1214/aos/1176344552) with a fixed seed
/// for reproducible tables. `statistic` receives the indices drawn.
fn interval(count: usize, statistic: impl Fn(&mut dyn Iterator<Item = usize>) -> f64) -> Span {
    let mut rng = Pcg64::seed_from_u64(count as u64);
    let mut values: Vec<f64> = (0..RESAMPLES)
        .map(|_| statistic(&mut (0..count).map(|_| rng.random_range(0..count))))
        .collect();
    values.sort_by(f64::total_cmp);
    Span::new(percentile(&values, 2.5), percentile(&values, 97.5))
}

/// Returns `error / motion`; 0 without motion, to avoid infinities.
fn ratio([error, motion]: [f64; 2]) -> f64 {
    if motion > 0.0 { error / motion } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_interpolate_between_ranks() {
        let sorted = [1.0, 2.0, 4.0, 8.0];
        for (p, expected) in [(0.0, 1.0), (50.0, 3.0), (100.0, 8.0), (90.0, 6.8), (25.0, 1.75)] {
            assert!((percentile(&sorted, p) - expected).abs() < 1e-12, "{p}");
        }
        assert_eq!(percentile(&[3.0], 95.0), 3.0);
    }

    #[test]
    fn the_interval_of_the_mean_is_that_of_the_normal_law() {
        // For 0 to 999 the standard deviation is 288.7, and the standard error of a thousand values
        // 9.13.
        let values: Vec<f64> = (0..1000).map(f64::from).collect();
        let summary = Summary::of(&values).expect("finite values");
        assert!((summary.mean - 499.5).abs() < 1e-9 && (summary.median - 499.5).abs() < 1e-9);
        let half = 1.96 * 9.13;
        assert!((summary.mean_interval.low - (499.5 - half)).abs() < 2.5, "{summary:?}");
        assert!((summary.mean_interval.high - (499.5 + half)).abs() < 2.5, "{summary:?}");
    }

    #[test]
    fn nothing_and_undefined_numbers_have_no_summary() {
        assert_eq!(Summary::of(&[]), None);
        assert_eq!(Summary::of(&[1.0, f64::NAN]), None);
    }
}
