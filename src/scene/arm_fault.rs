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
    /// A joint would have to accelerate faster than its limit, or change its acceleration faster.
    TooAbrupt {
        /// Name of the joint.
        joint: String,
        /// Whether the jerk is too high; otherwise it is the acceleration.
        jerk: bool,
        /// Required value, with radians or metres, and seconds to the second or third power.
        needed: f64,
        /// Limit of the joint in the same unit.
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
    /// The joint trajectory begins away from the arm's home, so the arm would jump.
    NotHome {
        /// Name of the joint.
        joint: String,
        /// Distance from its position at home, radians or metres.
        distance: f64,
    },
    /// A joint moves at the beginning or at the end of the joint trajectory.
    NotAtRest {
        /// Name of the joint.
        joint: String,
    },
    /// The tool would not move at the speed with which the plan was replayed.
    Pace {
        /// Speed of the tool, m/s.
        speed: f64,
        /// Speed in the plan, m/s.
        planned: f64,
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
            Self::Unreachable => write!(f, "no arm configuration reaches the whole push"),
            Self::Limit { joint } => write!(f, "joint `{joint}` would exceed its position limits"),
            Self::TooFast { joint, needed, limit } => write!(
                f,
                "joint `{joint}` would need a speed of {needed:.2}, above its limit of {limit:.2} \
                 (rad/s or m/s)"
            ),
            Self::TooAbrupt { joint, jerk, needed, limit } => {
                let what = if *jerk { "jerk" } else { "acceleration" };
                write!(
                    f,
                    "joint `{joint}` would need {article} {what} of {needed:.1}, above its limit \
                     of {limit:.1} (rad or m, s)",
                    article = if *jerk { "a" } else { "an" }
                )
            }
            Self::Singular => write!(f, "the arm comes too close to a singularity"),
            Self::Collides { between: [a, b] } => write!(f, "`{a}` collides with `{b}`"),
            Self::Off { distance } => {
                write!(f, "the tool would deviate from the plan by {:.1} mm", distance * 1e3)
            }
            Self::NotHome { joint, distance } => write!(
                f,
                "the joint trajectory begins with joint `{joint}` {distance:.3} (rad or m) from \
                 `home`"
            ),
            Self::NotAtRest { joint } => write!(
                f,
                "joint `{joint}` is not at rest at the beginning or the end of the trajectory"
            ),
            Self::Pace { speed, planned } => write!(
                f,
                "the joints would move the tool at {speed:.3} m/s instead of {planned:.3} m/s"
            ),
            Self::NoWay { between: [a, b] } => {
                write!(
                    f,
                    "the arm has no collision-free path to the push: `{a}` collides with `{b}`"
                )
            }
            Self::OfAnother => write!(f, "the joint trajectory belongs to another arm or plan"),
        }
    }
}
