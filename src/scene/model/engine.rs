//! The physics engines of the simulator.

use serde::{Deserialize, Serialize};

/// A physics engine of the simulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// Top-down, with its own law of support friction: the default truth for data and search.
    Planar,
    /// Full 3-D: the independent check.
    Spatial,
    /// The 3-D engine in which nothing tips: the physics of the plane, solved by other code.
    Upright,
}

impl Engine {
    /// The engines of a verdict, in the order in which they are shown: predictions are compared
    /// with the planar one.
    pub const ALL: [Self; 2] = [Self::Planar, Self::Spatial];
}
