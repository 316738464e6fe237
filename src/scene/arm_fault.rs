//! Reasons why an arm cannot carry out a plan.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The reason why an arm cannot carry out a push or the approach to it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ArmFault {
    /// No pose within the joint limits reaches the tool pose.
    Unreachable,
    /// A joint leaves its limits.
    Limit {
        /// Name of the joint.
        joint: String,
    },
    /// A joint would have to move faster than its speed limit.
    TooFast {
        /// Name of the joint.
        joint: String,
        /// Required speed, radians or metres a second.
        needed: f64,
        /// Speed limit of the joint, radians or metres a second.
        limit: f64,
    },
    /// The arm is so stretched out or folded that it cannot move in some direction.
    Singular,
    /// Two bodies of the arm overlap, or the arm overlaps an obstacle.
    Collides {
        /// Names of the two bodies.
        between: [String; 2],
    },
    /// The joint positions do not hold the tool at the planned pose.
    Off {
        /// Distance from the planned pose, metres; a rotation counts at a radius of 10 cm.
        distance: f64,
    },
    /// No collision-free path to the push was found.
    NoWay {
        /// Names of the two bodies that collided last.
        between: [String; 2],
    },
    /// The joint names differ from the joints of the arm, or the plan has other pushes.
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
