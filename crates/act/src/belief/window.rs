//! Evidence of a few consecutive observations about a hypothesis.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};

use pushplan::geometry::Pose;

use super::{
    density::student,
    fit::{Fit, Row},
    relative::{by_headings, relative, spread},
};

/// Standard deviations of a rollout over a window: metres, shares of the relative displacement, and
/// share of the displacement over the table.
///
/// The first relative share applies with observed headings, the second without, because the rollout
/// is then the main evidence for the joint type.
const MODEL: (f64, [f64; 2], f64) = (4e-4, [0.2, 0.1], 0.01);

/// Standard deviation of the error at a single instant relative to the error at the end.
pub(super) const UNEVEN: f64 = 0.2;

/// Standard deviation that the rollout of a window adds to the error of an unobserved heading:
/// radians, and share of the rotation.
const DRIFT: [f64; 2] = [0.02, 0.1];

/// Observed and rolled-out poses of a pair at one instant of a window.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant {
    /// Elapsed share of the window.
    pub share: f64,
    /// Observed poses; unobserved headings are the rolled-out ones.
    pub seen: [Pose; 2],
    /// Whether each heading was observed.
    pub headings: [bool; 2],
    /// Variances of observed positions and headings.
    pub variance: [[f64; 2]; 2],
    pub rolled: [Pose; 2],
    /// Standard deviations that the rollout has added to the errors of the headings.
    pub drift: [f64; 2],
}

/// Pair at an instant, with unobserved headings corrected by their errors.
pub(super) struct Look {
    /// Observed and predicted relative poses.
    pub seen: Vector3<f64>,
    pub predicted: Vector3<f64>,
    /// Covariance of the observation.
    pub spread: Matrix3<f64>,
    /// Jacobians of both with respect to the errors of unobserved headings.
    pub seen_by_errors: Matrix3x2<f64>,
    pub predicted_by_errors: Matrix3x2<f64>,
}

/// Returns the standard deviation that a rollout with rotation `turn` adds to an unobserved
/// heading's error.
pub(super) fn drift(turn: f64) -> f64 {
    DRIFT[0] + DRIFT[1] * turn.abs()
}

impl Instant {
    /// Returns the relative poses if the unobserved headings have these errors.
    pub fn look(&self, errors: &Vector2<f64>) -> Look {
        let turned = |poses: &[Pose; 2]| {
            let by = |k: usize| if self.headings[k] { 0.0 } else { errors[k] };
            [0, 1].map(|k| Pose { heading: poses[k].heading + by(k), ..poses[k] })
        };
        let [one, other] = turned(&self.seen);
        let seen = relative(&one, &other);
        let [one, other] = turned(&self.rolled);
        let predicted = relative(&one, &other);
        let by_errors = |relative: &Vector3<f64>| {
            let mut by = by_headings(relative);
            for (k, _) in self.headings.iter().enumerate().filter(|(_, seen)| **seen) {
                by.column_mut(k).fill(0.0);
            }
            by
        };
        let of = |which: usize| self.variance.map(|variance| variance[which]);
        Look {
            spread: spread(&seen, of(0), of(1)),
            seen_by_errors: by_errors(&seen),
            predicted_by_errors: by_errors(&predicted),
            seen,
            predicted,
        }
    }

    /// Returns the number of observed joint coordinates. The last one, a relative heading, is
    /// missing if neither heading was observed.
    fn rows(&self) -> usize {
        if self.headings == [false; 2] { 2 } else { 3 }
    }
}

/// Uncertainty of the rollout of a window.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    /// Covariance of the initial relative pose.
    pub start: Matrix3<f64>,
    /// Standard deviations that the rollout adds by its end: metres, radians.
    pub model: [f64; 2],
}

impl Doubt {
    /// Creates the uncertainty of a rollout in which a pair moves by `relative` metres (including
    /// rotations at `arm` metres) and each object by at most `whole` metres. `unseen` states
    /// whether headings are unobserved.
    pub fn new(start: Matrix3<f64>, relative: f64, whole: f64, arm: f64, unseen: bool) -> Self {
        let far = MODEL.0 + MODEL.1[usize::from(unseen)] * relative + MODEL.2 * whole;
        Self { start, model: [far, far / arm] }
    }
}

/// Returns the final residual of a window in joint coordinates, in standard deviations; zero for
/// unobserved coordinates.
pub(super) fn whitened(fit: &Fit, instants: &[Instant], doubt: &Doubt) -> [f64; 3] {
    let Some(now) = instants.last() else { return [0.0; 3] };
    let look = now.look(&fit.errors);
    let row = fit.read(&look);
    let drift = Matrix2::from_diagonal(&Vector2::from(now.drift.map(|sd| sd * sd)));
    let by_errors = row.by_state.fixed_columns::<2>(4);
    let known = row.by_state * fit.covariance * row.by_state.transpose()
        + by_errors * drift * by_errors.transpose()
        + row.noise(&look.spread);
    let start = row.by_seen * doubt.start * row.by_seen.transpose();
    [0, 1, 2].map(|k| {
        if k >= now.rows() {
            return 0.0;
        }
        let free = match row.held[k] {
            true => 0.0,
            false => start[(k, k)] + doubt.model[usize::from(k == 2)].powi(2),
        };
        row.off[k].abs() / (known[(k, k)] + free).max(1e-12).sqrt()
    })
}

/// Returns the log-density of a window under a hypothesis, up to a common constant.
pub(super) fn evidence(fit: &Fit, instants: &[Instant], doubt: &Doubt) -> f64 {
    let n = instants.iter().map(Instant::rows).sum();
    let mut off = DVector::zeros(n);
    let mut spread = DMatrix::zeros(n, n);
    let looks: Vec<Look> = instants.iter().map(|now| now.look(&fit.errors)).collect();
    let rows: Vec<Row> = looks.iter().map(|look| fit.read(look)).collect();
    let mut first = 0;
    for (k, (row, now)) in rows.iter().zip(instants).enumerate() {
        let high = now.rows();
        off.rows_mut(first, high).copy_from(&row.off.rows(0, high));
        let across = row.by_state * fit.covariance;
        let by_errors = row.by_state.fixed_columns::<2>(4);
        let mut second = 0;
        for (l, (other, then)) in rows.iter().zip(instants).enumerate() {
            let wide = then.rows();
            let drift = Vector2::from_fn(|i, _| now.drift[i] * then.drift[i]);
            let mut both = across * other.by_state.transpose()
                + by_errors
                    * Matrix2::from_diagonal(&drift)
                    * other.by_state.fixed_columns::<2>(4).transpose();
            let start = row.by_seen * doubt.start * other.by_seen.transpose();
            for i in 0..3 {
                for j in 0..3 {
                    if row.held[i] || row.held[j] {
                        continue;
                    }
                    both[(i, j)] += start[(i, j)];
                    if i == j {
                        // The model's error grows almost linearly over the window.
                        let model = doubt.model[usize::from(i == 2)];
                        let even = now.share * then.share;
                        let own = if k == l { UNEVEN * UNEVEN } else { 0.0 };
                        both[(i, j)] += (even + own) * model * model;
                    }
                }
            }
            if k == l {
                both += row.noise(&looks[k].spread);
            }
            spread
                .view_mut((first, second), (high, wide))
                .copy_from(&both.view((0, 0), (high, wide)));
            second += wide;
        }
        first += high;
    }
    student(&off, spread)
}
