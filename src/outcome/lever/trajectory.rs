//! How a plate moved when it was levered.

use serde::{Deserialize, Serialize};

use crate::geometry::Pose3;

use super::LeverWarning;
use crate::task::Ending;

/// Frames of a turn, at even times, the last one at its end.
pub const LEVER_FRAMES: usize = 15;

/// How the levered plate moved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverTrajectory {
    /// The plate's frame during the turn: at the end of each of [`LEVER_FRAMES`] equal times.
    pub lift: Vec<Pose3>,
    /// Of each of these, whether the plate lay on the blade.
    pub held: Vec<bool>,
    /// The plate's frame when everything rests.
    pub rest: Pose3,
    /// How it lies then.
    pub ending: Ending,
    /// What went wrong on the way.
    pub warnings: Vec<LeverWarning>,
}

impl LeverTrajectory {
    /// Whether the plate slid off the blade.
    pub fn slipped(&self) -> bool {
        self.warnings.contains(&LeverWarning::Slipped)
    }

    /// Frames before the plate slips off the blade: all if it does not.
    pub fn before_slip(&self) -> usize {
        let held = || self.held.iter().rposition(|held| *held).map_or(0, |frame| frame + 1);
        if self.slipped() { held() } else { self.lift.len() }
    }
}

/// Whether the plate was off the blade at the end of the turn and had fallen back since it left
/// it; one that tips over the far side leaves the blade too, and leans on.
pub fn has_slipped(start: &Pose3, lift: &[Pose3], held: &[bool]) -> bool {
    let last_held = held.iter().rposition(|held| *held);
    match last_held {
        Some(frame) if frame + 1 == held.len() => false,
        Some(frame) => lift[lift.len() - 1].tilt() < lift[frame].tilt(),
        None => lift[lift.len() - 1].tilt() <= start.tilt() + lift[0].tilt(),
    }
}
