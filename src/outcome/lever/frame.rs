//! Everything that moves in a lever-up, at even times: what pictures are made of.

use serde::{Deserialize, Serialize};

use crate::geometry::Pose3;

/// Where plates and blade are at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverFrame {
    /// Since the turn began, seconds.
    pub time: f64,
    /// The blade's centre.
    pub blade: Pose3,
    /// The plates' frames, in the scene's order.
    pub plates: Vec<Pose3>,
    /// Force of the plates on the blade during the last time step, newtons.
    pub force: f64,
}

/// A lever-up from its start until everything rests.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverRecord {
    /// In order; the first is the start and the last the rest.
    pub frames: Vec<LeverFrame>,
}
