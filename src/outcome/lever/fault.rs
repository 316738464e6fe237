//! Faults of lever-ups.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Violation by a lever-up of its task's rules or of the robot's abilities.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverFault {
    /// A value that the task does not allow.
    ForbiddenLever {
        /// Name of the forbidden quantity.
        what: String,
    },
    /// The lever point is closer to a corner than blades may be placed.
    NearCorner,
    /// The blade is thicker than the clearance below the edge.
    TooThick,
    /// The tip would come out on the far side of the plate, or has no room beneath it.
    TooDeep,
    /// The blade would pass through a fixed body, or through an object on its way to the edge.
    Meets {
        /// Name of the body that the blade meets.
        body: String,
    },
    /// The fingers that hold the shaft behind the blade would pass through another body.
    HandMeets {
        /// Name of the body that the fingers meet.
        body: String,
    },
    /// The object lies elsewhere than the plan expects when the blade comes.
    Displaced,
    /// The shaft would pass through the table.
    BelowTable,
    /// The end effector would leave its reach.
    OutOfReach,
    /// The task has an arm, for which no lever-ups are planned.
    ByArm,
    /// The tool has no blade.
    NoBlade,
    /// No support line exists for the axis of rotation.
    NoSupport,
    /// The lever-up takes longer than [`LeverUp::LONGEST`](crate::task::LeverUp::LONGEST).
    TooLong,
}

impl fmt::Display for LeverFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ForbiddenLever { what } => write!(f, "the task does not allow this {what}"),
            Self::NoBlade => f.write_str("the tool has no blade"),
            Self::NearCorner => f.write_str("the lever point is too close to a corner"),
            Self::TooThick => f.write_str("the blade is thicker than the clearance below the edge"),
            Self::TooDeep => f.write_str("the blade would reach through below the whole plate"),
            Self::Meets { body } => write!(f, "the blade would pass through {body}"),
            Self::HandMeets { body } => {
                write!(f, "the fingers behind the blade would pass through {body}")
            }
            Self::Displaced => f.write_str("the object does not lie where the plan expects it"),
            Self::ByArm => f.write_str("a lever-up is planned for a hand, not for an arm's joints"),
            Self::BelowTable => f.write_str("the shaft would pass through the table"),
            Self::OutOfReach => f.write_str("the end effector would leave its reach"),
            Self::TooLong => f.write_str("the lever-up would take more than two minutes"),
            Self::NoSupport => f.write_str("no support line defines the axis of rotation"),
        }
    }
}
