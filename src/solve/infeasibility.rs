//! Infeasibility: the single limit that prevents a plan.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::scene::ArmFault;

/// Single limit that prevents a plan. The limit was relaxed in a trial, and then a plan is
/// predicted to reach the goal. Lengths are in metres; `needed` is the smallest value among the
/// plans found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// More pushes are needed.
    Pushes {
        /// Number of pushes allowed.
        allowed: usize,
        /// Number of pushes needed.
        needed: usize,
    },
    /// A push would have to be longer.
    Length {
        /// Length in the task.
        allowed: f64,
        /// Length needed.
        needed: f64,
    },
    /// No push in an allowed direction reaches the goal.
    Directions,
    /// The tool would need another grip yaw.
    GripYaws {
        /// Grip yaw needed, radians.
        needed: f64,
    },
    /// The end effector would need a larger reach.
    Far {
        /// Outer reach of the robot.
        allowed: f64,
        /// Reach needed.
        needed: f64,
    },
    /// The end effector would have to come closer to the base.
    Near {
        /// Inner reach of the robot.
        allowed: f64,
        /// Reach needed.
        needed: f64,
    },
    /// A tool that the task does not name would work.
    Tool {
        /// Name of the tool.
        needed: String,
    },
    /// An object joined to the goal's object can be pushed to the goal, and the goal's object
    /// itself cannot.
    Joined {
        /// Name of the object to state in the goal.
        needed: String,
    },
    /// An object that must stay, or a keep-out region, obstructs every plan.
    Kept,
    /// The hand would collide with a body.
    Hand,
    /// The robot's base obstructs every plan.
    Base,
    /// Plans are predicted to reach the goal, but the arm cannot execute them.
    Arm {
        /// Fault of the best plan.
        fault: ArmFault,
    },
    /// An obstacle obstructs every plan.
    Obstacle {
        /// Name of the obstacle.
        name: String,
    },
    /// No single limit: each was relaxed separately without success.
    Several,
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let centimetres = |metres: f64| (metres * 100.0).round() / 100.0;
        match self {
            Cause::Pushes { allowed, needed } => {
                write!(f, "it takes {needed} pushes, and `pushes.max_count` is {allowed}")
            }
            Cause::Length { allowed, needed } => write!(
                f,
                "pushes are too short; `pushes.length` is {allowed} m, and {} would do",
                centimetres(*needed)
            ),
            Cause::Directions => f.write_str(
                "no allowed direction leads there, and others do; widen `pushes.directions`",
            ),
            Cause::GripYaws { needed } => write!(
                f,
                "the tool would have to be gripped at another turn; {:.0} degrees in \
                 `pushes.grip_yaws_deg` would do",
                needed.to_degrees()
            ),
            Cause::Far { allowed, needed } => write!(
                f,
                "it is too far away; the end effector would have to reach {} m, and \
                 `robot.reach.max` is {allowed}",
                centimetres(*needed)
            ),
            Cause::Near { allowed, needed } => write!(
                f,
                "it is too near; the end effector would have to come within {} m of the base, and \
                 `robot.reach.min` is {allowed}",
                centimetres(*needed)
            ),
            Cause::Tool { needed } => {
                write!(f, "the tools do not do; `{needed}` would, which `tools` does not name")
            }
            Cause::Joined { needed } => write!(
                f,
                "`goal.object` cannot be pushed there itself; `{needed}` can, which hangs together \
                 with it"
            ),
            Cause::Kept => f.write_str("what `keep` or `keep_out` names is in the way"),
            Cause::Hand => f.write_str(
                "the hand would meet something; without it there is a way, see `robot.hand`",
            ),
            Cause::Arm { fault } => {
                write!(f, "there are plans that the arm cannot carry out; in the best one {fault}")
            }
            Cause::Base => f.write_str("the robot's base is in the way, see `robot.base`"),
            Cause::Obstacle { name } => write!(f, "obstacle `{name}` is in the way"),
            Cause::Several => f.write_str("no wider limit alone would do"),
        }
    }
}
