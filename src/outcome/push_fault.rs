//! What of a push a task does not allow.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What of a push a task does not allow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PushFault {
    /// The task's pushes begin in another way: from above, or where the last one ended.
    Form,
    /// The tool's underside is not as high as the task says, but at this height, metres.
    Lift(f64),
    /// It is the first of chained pushes and begins so far from the robot's home, metres.
    Home(f64),
    /// It is chained and begins so far from where the last push ended, metres.
    Apart(f64),
    /// It goes where no direction of the task goes, nor a refined one: radians.
    Direction(f64),
    /// It is longer than refinement may make it, metres.
    Length(f64),
    /// It is faster than the task says, m/s.
    Speed(f64),
    /// It takes longer than [`Push::LONGEST`](crate::task::Push::LONGEST), seconds.
    TooLong(f64),
}

impl fmt::Display for PushFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form => write!(f, "is not of the form that the task allows"),
            Self::Lift(lift) => {
                write!(
                    f,
                    "holds the tool {:.1} mm above the table, which the task does not",
                    lift * 1e3
                )
            }
            Self::Home(distance) => {
                write!(
                    f,
                    "begins {:.1} mm from the robot's home, where chained pushes begin",
                    distance * 1e3
                )
            }
            Self::Apart(distance) => write!(
                f,
                "begins {:.1} mm from where the last one ended, and the tool stays down",
                distance * 1e3
            ),
            Self::Direction(direction) => write!(
                f,
                "goes along {:.1} degrees, far from any direction that the task allows",
                direction.to_degrees()
            ),
            Self::Length(length) => {
                write!(f, "is {:.1} mm long, longer than the task allows", length * 1e3)
            }
            Self::Speed(speed) => write!(f, "goes at {speed} m/s, faster than the task says"),
            Self::TooLong(duration) => write!(f, "takes {duration:.0} s, too long to be replayed"),
        }
    }
}
