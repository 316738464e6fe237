//! Recorded ends as the numbers of a regression.

use crate::judge::Trial;
use pushplan::effect::Network;
use pushplan::geometry::wrap_angle;

use super::Sensitivity;

/// How one object ends, and how that follows the head.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    /// From the predicted to the recorded end, metres: x, y and, if the heading is known, the turn
    /// at the radius of gyration.
    pub residual: Vec<f64>,
    /// How the predicted end follows each number of the head, one row for each of `residual`.
    pub rows: Vec<Vec<f64>>,
}

/// What `network` says of the ends of the objects of `trial` for which `moves` says so.
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
