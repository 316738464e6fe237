//! Trajectory of a levered plate.

use serde::{Deserialize, Serialize};

use crate::geometry::Pose3;

use super::LeverWarning;
use crate::task::Ending;

/// Number of frames of a levering rotation, evenly spaced in time, the last one at its end.
pub const LEVER_FRAMES: usize = 15;

/// Motion of a levered plate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverTrajectory {
    /// Frame of the plate at the end of each of [`LEVER_FRAMES`] equal intervals of the rotation.
    pub lift: Vec<Pose3>,
    /// Whether the plate lay on the blade, for each frame of `lift`.
    pub held: Vec<bool>,
    /// Frame of the plate when everything is at rest.
    pub rest: Pose3,
    /// Side on which the plate lies at rest.
    pub ending: Ending,
    /// Warnings raised during the motion.
    pub warnings: Vec<LeverWarning>,
}

impl LeverTrajectory {
    /// Returns `true` if the plate slid off the blade.
    pub fn slipped(&self) -> bool {
        self.warnings.contains(&LeverWarning::Slipped)
    }

    /// Returns the number of frames before the plate slips off the blade: all if it does not.
    pub fn before_slip(&self) -> usize {
        let held = || self.held.iter().rposition(|held| *held).map_or(0, |frame| frame + 1);
        if self.slipped() { held() } else { self.lift.len() }
    }
}

/// Returns `true` if the plate was off the blade at the end of the rotation and has fallen back
/// since it left the blade. A plate that tips over the far side also leaves the blade, but its tilt
/// keeps growing.
pub fn has_slipped(start: &Pose3, lift: &[Pose3], held: &[bool]) -> bool {
    let last_held = held.iter().rposition(|held| *held);
    match last_held {
        Some(frame) if frame + 1 == held.len() => false,
        Some(frame) => lift[lift.len() - 1].tilt() < lift[frame].tilt(),
        None => lift[lift.len() - 1].tilt() <= start.tilt() + lift[0].tilt(),
    }
}
