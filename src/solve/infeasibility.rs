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
                write!(f, "the task needs {needed} pushes, but `pushes.max_count` is {allowed}")
            }
            Cause::Length { allowed, needed } => write!(
                f,
                "pushes are too short: `pushes.length` is {allowed} m, but {} m would suffice",
                centimetres(*needed)
            ),
            Cause::Directions => f.write_str(
                "no allowed direction leads to the goal, but others do; widen `pushes.directions`",
            ),
            Cause::GripYaws { needed } => write!(
                f,
                "no allowed grip yaw works, but {:.0} degrees would; add it to \
                 `pushes.grip_yaws_deg`",
                needed.to_degrees()
            ),
            Cause::Far { allowed, needed } => write!(
                f,
                "the pushes are too far away: the end effector would have to reach {} m, but \
                 `robot.reach.max` is {allowed} m",
                centimetres(*needed)
            ),
            Cause::Near { allowed, needed } => write!(
                f,
                "the pushes are too near: the end effector would have to come within {} m of the \
                 base, but `robot.reach.min` is {allowed} m",
                centimetres(*needed)
            ),
            Cause::Tool { needed } => {
                write!(f, "no allowed tool works, but `{needed}` does; add it to `tools`")
            }
            Cause::Joined { needed } => write!(
                f,
                "`goal.object` cannot be pushed there directly, but `{needed}`, which is joined to \
                 it, can"
            ),
            Cause::Kept => {
                f.write_str("a body or region named by `keep` or `keep_out` obstructs every plan")
            }
            Cause::Hand => {
                f.write_str("a collision of the hand obstructs every plan; see `robot.hand`")
            }
            Cause::Arm { fault } => {
                write!(f, "plans exist, but the arm cannot execute them; in the best one {fault}")
            }
            Cause::Base => f.write_str("the robot's base obstructs every plan; see `robot.base`"),
            Cause::Obstacle { name } => write!(f, "obstacle `{name}` obstructs every plan"),
            Cause::Several => f.write_str("relaxing any single limit is not enough"),
        }
    }
}
