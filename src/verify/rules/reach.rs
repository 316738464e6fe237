//! Rules of the robot's reach.

use crate::geometry::{Pose3, Vector3};
use crate::outcome::{LeverFault, Warning};
use crate::scene::{Blade, Robot};
use crate::task::{Push, PushStep, Task};

use super::SLACK;

/// Returns a warning if the end effector leaves its reach during a push.
pub(super) fn out_of_reach(task: &Task, (push, step): (usize, &PushStep)) -> Option<Warning> {
    (!is_within_reach(&task.robot, &step.push)).then_some(Warning::OutOfReach { push })
}

/// Returns `true` if the end effector stays within reach during a push.
fn is_within_reach(robot: &Robot, push: &Push) -> bool {
    let (from, to) = (push.start, push.end());
    let way = to - from;
    let square = way.norm_squared();
    let nearest = if square > 0.0 { (-from.dot(&way) / square).clamp(0.0, 1.0) } else { 0.0 };
    from.norm().max(to.norm()) <= robot.reach_max + SLACK
        && (from + nearest * way).norm() >= robot.reach_min - SLACK
}

/// Returns a fault if the end effector is out of reach when it holds the blade with its centre at
/// `pose`.
pub(super) fn blade_out_of_reach(robot: &Robot, blade: &Blade, pose: &Pose3) -> Option<LeverFault> {
    let grip = pose.point(Vector3::new(-0.5 * blade.length, 0.0, 0.0)).xy().norm();
    let outside = grip < robot.reach_min - SLACK || grip > robot.reach_max + SLACK;
    outside.then_some(LeverFault::OutOfReach)
}
