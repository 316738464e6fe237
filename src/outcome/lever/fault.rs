//! Why a lever-up cannot be made.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What a lever-up does that no robot can do or its task does not allow.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverFault {
    /// A depth, angle, axis or plate that the task does not allow.
    ForbiddenLever {
        /// Which of them.
        what: String,
    },
    /// A lever point that is nearer to a corner than blades are set.
    NearCorner,
    /// The blade is thicker than the free height below the edge.
    TooThick,
    /// The tip would come out at the other side of the plate, or has no room beneath it.
    TooDeep,
    /// The blade would go through something fixed.
    Meets {
        /// The name of what it meets.
        body: String,
    },
    /// The fingers that hold the shaft behind the blade would go through something fixed.
    HandMeets {
        /// The name of what they meet.
        body: String,
    },
    /// The shaft would go through the table.
    BelowTable,
    /// The end effector cannot be everywhere where it would have to be.
    OutOfReach,
    /// The tool has no blade.
    NoBlade,
    /// There is no support line that the axis could lie on.
    NoSupport,
    /// It takes longer than [`LeverUp::LONGEST`](crate::task::LeverUp::LONGEST).
    TooLong,
}

impl fmt::Display for LeverFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ForbiddenLever { what } => write!(f, "the task does not allow this {what}"),
            Self::NoBlade => f.write_str("the tool has no blade"),
            Self::NearCorner => f.write_str("the lever point is too close to a corner"),
            Self::TooThick => f.write_str("the blade is thicker than the clearance below the edge"),
            Self::TooDeep => f.write_str("the blade would reach through under the whole plate"),
            Self::Meets { body } => write!(f, "the blade would go through {body}"),
            Self::HandMeets { body } => {
                write!(f, "the fingers behind the blade would go through {body}")
            }
            Self::BelowTable => f.write_str("the shaft would go through the table"),
            Self::OutOfReach => f.write_str("the end effector would leave its reach"),
            Self::TooLong => f.write_str("it would take more than two minutes"),
            Self::NoSupport => f.write_str("no support line to turn about"),
        }
    }
}
