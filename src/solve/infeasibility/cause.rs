//! Causes that prevent a plan.

use serde::{Deserialize, Serialize};

use crate::scene::ArmFault;

/// Cause that prevents a plan. Except for the distances of [`Cause::Beyond`] and
/// [`Cause::TooFewPushes`], a limit was relaxed or a body removed in a trial, and then a plan works
/// in both engines. Lengths are in metres; `needed` is the smallest value among the plans found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// An object or its goal is farther away than the arm with the longest tool reaches.
    Beyond {
        /// Name of the object, or `the goal of` it.
        subject: String,
        /// Distance from the base.
        distance: f64,
        /// Largest distance at which a tool can have an effect.
        possible: f64,
        /// Outer reach of the robot that suffices.
        needed: f64,
        /// Length of pushes that suffices, if the allowed ones are too short as well.
        length: Option<f64>,
    },
    /// The allowed pushes together are shorter than the way to the goal.
    TooFewPushes {
        /// Way that the object has to be moved.
        distance: f64,
        /// Number of pushes allowed.
        allowed: usize,
        /// Length of one push in the task.
        length: f64,
        /// Length of a push that suffices.
        needed: f64,
    },
    /// Walls enclose the object or its goal.
    Enclosed {
        /// Name of the object, or `the goal of` it.
        subject: String,
        /// Names of the walls.
        by: Vec<String>,
        /// Names of the bodies to remove.
        open: Vec<String>,
    },
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
    Directions {
        /// Number of evenly spaced directions that suffices.
        needed: usize,
    },
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
    /// The force exceeds the limit of the robot or of an object.
    Force {
        /// Name of the object with the limit; `None` for the robot.
        object: Option<String>,
        /// Force allowed, newtons.
        allowed: f64,
        /// Force needed, newtons.
        needed: f64,
    },
    /// The tool would have to be held higher or lower.
    Lift {
        /// Lift in the task.
        allowed: f64,
        /// Lift needed.
        needed: f64,
    },
    /// The lifted tool would have to travel higher.
    Travel {
        /// Height in the task.
        allowed: f64,
        /// Height needed.
        needed: f64,
    },
    /// Objects that must stay, or keep-out regions, obstruct every plan.
    Kept {
        /// Names of the objects and regions.
        names: Vec<String>,
    },
    /// The hand or the handle of the tool meets bodies.
    Hand {
        /// Names of the bodies.
        meets: Vec<String>,
    },
    /// The robot's base obstructs every plan.
    Base,
    /// Plans are predicted to reach the goal, but the arm cannot execute them.
    Arm {
        /// Fault of the best plan.
        fault: ArmFault,
    },
    /// Movable objects would have to be cleared first.
    Clear {
        /// Names of the objects.
        objects: Vec<String>,
        /// Number of pushes allowed.
        allowed: usize,
    },
    /// Bodies obstruct every plan, at least one of which is fixed.
    Obstructed {
        /// Names of the bodies.
        names: Vec<String>,
    },
    /// No single limit: each was relaxed separately without success.
    Several,
}
