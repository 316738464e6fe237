//! How a lever-up ended.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::geometry::Pose3;

/// A plate that lies on its underside leans less than this, radians (15 degrees): an edge may lie on
/// the wall of a pocket. Single plates end within a degree of flat.
const FLAT: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// An upside-down plate leans less than this off the vertical, radians (45 degrees): boards that are
/// turned out of a drive lie on its wall, 147 to 170 degrees from where they were.
const UPSIDE_DOWN: f64 = 45.0 * std::f64::consts::PI / 180.0;

/// How the levered plate lies when everything rests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// On its underside again.
    Back,
    /// Upside down.
    Flipped,
    /// Against something, or on edge.
    Leaning,
}

impl Ending {
    /// How a plate lies at rest in this pose.
    pub fn of(rest: &Pose3) -> Self {
        let tilt = rest.tilt();
        if tilt < FLAT {
            Self::Back
        } else if tilt > std::f64::consts::PI - UPSIDE_DOWN {
            Self::Flipped
        } else {
            Self::Leaning
        }
    }
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Back => "back on its underside",
            Self::Flipped => "flipped",
            Self::Leaning => "leaning",
        })
    }
}

/// What lowers the trust in a lever-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverWarning {
    /// The plate slid off the blade during the turn.
    Slipped,
    /// Forces grew as they do when something is jammed.
    Jammed,
    /// It did not come to rest in time.
    Moving,
}

impl fmt::Display for LeverWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Slipped => "the plate slipped off the blade",
            Self::Jammed => "something is jammed",
            Self::Moving => "the plate did not come to rest",
        })
    }
}
