//! Recorded final poses as regression data.

use crate::judge::Trial;
use pushplan::effect::Network;
use pushplan::geometry::wrap_angle;

use super::Sensitivity;

/// Final residual of one object with its Jacobian.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    /// Residual from the predicted to the recorded pose, metres: x, y and, if the heading is known,
    /// the rotation at the radius of gyration.
    pub residual: Vec<f64>,
    /// Derivatives of the predicted pose by the head parameters, one row per element of `residual`.
    pub rows: Vec<Vec<f64>>,
}

/// Returns the final residuals of the objects of `trial` selected by `moves`.
pub(super) fn observed(network: &Network, trial: &Trial, moves: &[bool]) -> Vec<Observed> {
    let Some(truth) = trial.truth.last() else { return Vec::new() };
    let found = Sensitivity::of(network, &trial.scene, &trial.job());
    let Some(end) = found.trajectory.frames.last().map(|frame| &frame.state) else {
        return Vec::new();
    };
    let of = |k: usize| {
        let (true_pose, pose) = (truth.poses[k], end.poses[k]);
        let away = true_pose.position - pose.position;
        let arm = trial.scene.objects[k].shape.footprint().gyration_radius();
        let mut residual = vec![away.x, away.y];
        let mut rows = found.rows[3 * k..3 * k + 2].to_vec();
        if trial.headings[k] && !trial.scene.objects[k].shape.is_cylinder() {
            residual.push(arm * wrap_angle(true_pose.heading - pose.heading));
            rows.push(found.rows[3 * k + 2].iter().map(|value| arm * value).collect());
        }
        Observed { residual, rows }
    };
    let moving = (0..trial.scene.objects.len()).filter(|&k| moves[k]).map(of);
    moving.filter(|one| one.residual.iter().all(|value| value.is_finite())).collect()
}
