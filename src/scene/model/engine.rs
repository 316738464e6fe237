//! The physics engines of the simulator.

use serde::{Deserialize, Serialize};

/// A physics engine of the simulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// 2-D engine with its own law of support friction: the default ground truth for data and
    /// search.
    Planar,
    /// Full 3-D engine: the independent check.
    Spatial,
    /// 3-D engine in which no object tips: planar physics, solved by other code.
    Upright,
}

impl Engine {
    /// Engines of a verdict, in display order; predictions are compared with the 2-D engine.
    pub const ALL: [Self; 2] = [Self::Planar, Self::Spatial];
}
