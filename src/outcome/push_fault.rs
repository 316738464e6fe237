//! Violations of a task's rules by a push.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Violation of a task's rules by a push.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PushFault {
    /// The push has another form than the task's: it starts from above or at the end of the last
    /// push.
    Form,
    /// The height of the tool's underside is not the task's but this one, metres.
    Lift(f64),
    /// The first of chained pushes begins this far from the robot's home, metres.
    Home(f64),
    /// A chained push begins this far from the end of the previous push, metres.
    Apart(f64),
    /// The direction is neither one of the task's nor a refinement of one, radians.
    Direction(f64),
    /// The push has this length, longer than refinement allows, metres.
    Length(f64),
    /// The push has this speed, not the task's, m/s.
    Speed(f64),
    /// The push has this duration, longer than [`Push::LONGEST`](crate::task::Push::LONGEST),
    /// seconds.
    TooLong(f64),
}

impl fmt::Display for PushFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form => {
                write!(f, "does not have the form (`placed` or `chained`) that the task requires")
            }
            Self::Lift(lift) => {
                write!(
                    f,
                    "holds the tool {:.1} mm above the table, not at the `lift` of the task",
                    lift * 1e3
                )
            }
            Self::Home(distance) => {
                write!(
                    f,
                    "begins {:.1} mm from the robot's home, where chained pushes must begin",
                    distance * 1e3
                )
            }
            Self::Apart(distance) => write!(
                f,
                "begins {:.1} mm from the end of the previous push, although the tool is not \
                 lifted between the two",
                distance * 1e3
            ),
            Self::Direction(direction) => write!(
                f,
                "has the direction {:.1} degrees, which is far from every direction that the task \
                 allows",
                direction.to_degrees()
            ),
            Self::Length(length) => {
                write!(f, "is {:.1} mm long, longer than the task allows", length * 1e3)
            }
            Self::Speed(speed) => {
                write!(f, "has a speed of {speed} m/s, not the `speed` of the task")
            }
            Self::TooLong(duration) => write!(f, "takes {duration:.0} s, too long for a replay"),
        }
    }
}
