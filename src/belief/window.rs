//! What a few observations in a row say of a hypothesis.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::{density::student, fit::Fit};

/// Error of a rollout over a window, as standard deviations: metres, and shares of how far two
/// objects move against each other and over the table.
const MODEL: [f64; 3] = [4e-4, 0.2, 0.01];

/// How unevenly that grows: the error of a single instant as a share of that at the end.
const UNEVEN: f64 = 0.2;

/// Where a pair was seen at one instant of a window, and where a rollout under some type of joint had
/// it: relative poses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant {
    /// Share of the window that has passed.
    pub share: f64,
    pub seen: Vector3<f64>,
    pub spread: Matrix3<f64>,
    pub predicted: Vector3<f64>,
}

/// What is not known of the rollout of a window.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    /// Covariance of the relative pose that it began with.
    pub start: Matrix3<f64>,
    /// Standard deviation of what it adds by its end: metres, radians.
    pub model: [f64; 2],
}

impl Doubt {
    /// Of a rollout in which a pair moves against each other by `relative` metres (turns at `arm`
    /// metres counted in), either over the table by at most `whole`.
    pub fn new(start: Matrix3<f64>, relative: f64, whole: f64, arm: f64) -> Self {
        let far = MODEL[0] + MODEL[1] * relative + MODEL[2] * whole;
        Self { start, model: [far, far / arm] }
    }
}

/// How far the last instant of a window is off under a hypothesis in each of its coordinates, in
/// standard deviations.
pub(super) fn whitened(fit: &Fit, instants: &[Instant], doubt: &Doubt) -> [f64; 3] {
    let Some(now) = instants.last() else { return [0.0; 3] };
    let row = fit.read(&now.seen, &now.predicted);
    let geometry = row.by_geometry * fit.covariance * row.by_geometry.transpose();
    let start = row.by_seen * doubt.start * row.by_seen.transpose();
    let noise = row.noise(&now.spread);
    [0, 1, 2].map(|k| {
        let free = match row.held[k] {
            true => 0.0,
            false => start[(k, k)] + doubt.model[usize::from(k == 2)].powi(2),
        };
        let variance = noise[(k, k)] + geometry[(k, k)] + free;
        row.off[k].abs() / variance.max(1e-12).sqrt()
    })
}

/// Logarithm of the density of a window under a hypothesis, up to what is the same for all.
pub(super) fn evidence(fit: &Fit, instants: &[Instant], doubt: &Doubt) -> f64 {
    let n = 3 * instants.len();
    let mut off = DVector::zeros(n);
    let mut spread = DMatrix::zeros(n, n);
    let rows: Vec<_> = instants.iter().map(|now| fit.read(&now.seen, &now.predicted)).collect();
    for (k, (row, now)) in rows.iter().zip(instants).enumerate() {
        off.fixed_rows_mut::<3>(3 * k).copy_from(&row.off);
        let own = row.noise(&now.spread);
        let mut place = spread.fixed_view_mut::<3, 3>(3 * k, 3 * k);
        place += own;
    }
    for (k, (row, now)) in rows.iter().zip(instants).enumerate() {
        let across = row.by_geometry * fit.covariance;
        for (l, (other, then)) in rows.iter().zip(instants).enumerate() {
            let mut both = across * other.by_geometry.transpose();
            let start = row.by_seen * doubt.start * other.by_seen.transpose();
            for i in 0..3 {
                for j in 0..3 {
                    if row.held[i] || row.held[j] {
                        continue;
                    }
                    both[(i, j)] += start[(i, j)];
                    if i == j {
                        // The model goes astray nearly evenly over the window.
                        let model = doubt.model[usize::from(i == 2)];
                        let even = now.share * then.share;
                        let own = if k == l { UNEVEN * UNEVEN } else { 0.0 };
                        both[(i, j)] += (even + own) * model * model;
                    }
                }
            }
            let mut place = spread.fixed_view_mut::<3, 3>(3 * k, 3 * l);
            place += both;
        }
    }
    student(&off, spread)
}
