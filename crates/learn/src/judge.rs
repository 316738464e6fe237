//! Errors of predicted lever-ups.

use serde::{Deserialize, Serialize};

use pushplan::internals::geometry::Pose3;
use pushplan::internals::{outcome::LeverTrajectory, task::LeverJob};

/// Differences between two trajectories of a lever-up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverError {
    /// Root mean square distance of the centres of mass over the frames of the rotation, metres.
    pub lift: f64,
    /// Distance of the centres of mass at the end of the rotation, metres.
    pub last: f64,
    /// Angle between both orientations at the end of the rotation, radians.
    pub turn: f64,
    /// Distance of the centres of mass at rest, metres.
    pub rest: f64,
    /// Whether both slip or both do not slip.
    pub same_slip: bool,
    /// Whether both have the same ending.
    pub same_ending: bool,
}

/// Compares the trajectory `predicted` for `job` with the ground truth.
pub fn lever_error(
    job: &LeverJob,
    truth: &LeverTrajectory,
    predicted: &LeverTrajectory,
) -> LeverError {
    let centre = job.scene.plates[job.lever.plate].weight().centre;
    let apart = |a: &Pose3, b: &Pose3| (a.point(centre) - b.point(centre)).norm();
    let pairs = || truth.lift.iter().zip(&predicted.lift);
    let squares: f64 = pairs().map(|(a, b)| apart(a, b).powi(2)).sum();
    let (last, turn) =
        pairs().next_back().map_or((0.0, 0.0), |(a, b)| (apart(a, b), a.angle_to(b)));
    LeverError {
        lift: (squares / truth.lift.len().max(1) as f64).sqrt(),
        last,
        turn,
        rest: apart(&truth.rest, &predicted.rest),
        same_slip: truth.slipped() == predicted.slipped(),
        same_ending: truth.ending == predicted.ending,
    }
}
