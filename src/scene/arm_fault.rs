//! What an arm cannot do.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Why no pose of an arm carries out a push, or brings it there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ArmFault {
    /// It does not reach there with its joints within their limits.
    Unreachable,
    /// A joint leaves its limits.
    Limit {
        /// Its name.
        joint: String,
    },
    /// A joint would have to be faster than it is.
    TooFast {
        /// Its name.
        joint: String,
        /// How fast, radians or metres a second.
        needed: f64,
        /// How fast it is.
        limit: f64,
    },
    /// It is stretched out or folded so that it cannot move on in some direction.
    Singular,
    /// Two things of the arm, or the arm and something that stands there, are in each other.
    Collides {
        /// Their names.
        between: [String; 2],
    },
    /// The joints do not hold the tool where the plan has it.
    Off {
        /// How far, metres; a turn counts at 10 cm.
        distance: f64,
    },
    /// There is no way to it, around what was met last.
    NoWay {
        /// The names of what met.
        between: [String; 2],
    },
    /// The joints are others than the arm has, or the plan has other pushes.
    OfAnother,
}

impl fmt::Display for ArmFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreachable => write!(f, "no pose of the arm reaches all of it"),
            Self::Limit { joint } => write!(f, "joint `{joint}` would leave its limits"),
            Self::TooFast { joint, needed, limit } => write!(
                f,
                "joint `{joint}` would have to move at {needed:.2} a second and does at most \
                 {limit:.2}"
            ),
            Self::Singular => write!(f, "the arm comes too near to a singular pose"),
            Self::Collides { between: [a, b] } => write!(f, "`{a}` runs into `{b}`"),
            Self::Off { distance } => {
                write!(f, "the joints hold the tool {:.1} mm off the plan", distance * 1e3)
            }
            Self::NoWay { between: [a, b] } => {
                write!(f, "the arm finds no way there: `{a}` runs into `{b}`")
            }
            Self::OfAnother => write!(f, "the joint trajectory is one of another arm or plan"),
        }
    }
}
