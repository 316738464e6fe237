//! Timing of a joint trajectory: its beginning and end at rest, and the speed of the tool.

use pushplan::geometry::Pose3;
use pushplan::scene::{ArmFault, JointTrajectory};
use pushplan::task::PushStep;

use super::judge::effector;
use super::model::Arm;
use super::path::{GENTLE, SPACING};

/// Tolerance for rounding of joint positions and speeds, radians and metres.
const SLACK: f64 = 1e-6;

/// Relative tolerance of the tool's speed along a push, because joints follow cubics between
/// points.
const EVEN: f64 = 0.03;

/// Relative tolerance where the tool accelerates and decelerates: a cubic that joins a ramp is up
/// to a sixth faster than its mean.
const RAMP: f64 = 0.25;

/// Number of parts of an interval in which the speed of the tool is measured.
const PARTS: usize = 4;

/// Returns a fault if the joints are not at home and at rest at the beginning, or not at rest at
/// the end.
pub(super) fn unrested(arm: &Arm, path: &JointTrajectory) -> Option<ArmFault> {
    let [first, last] = [path.points.first()?, path.points.last()?];
    let mut joints = arm.joints.iter().enumerate();
    joints.find_map(|(k, joint)| {
        let joint = joint.name.clone();
        let distance = (first.positions[k] - arm.home[k]).abs();
        if distance > SLACK {
            return Some(ArmFault::NotHome { joint, distance });
        }
        let moves = |velocities: &[f64]| velocities[k].abs() > SLACK;
        (moves(&first.velocities) || moves(&last.velocities))
            .then_some(ArmFault::NotAtRest { joint })
    })
}

/// Returns a fault if the tool does not follow a push at its speed between these two points. It may
/// accelerate and decelerate within two intervals of the planner at each end.
pub(super) fn uneven(
    arm: &Arm,
    step: &PushStep,
    path: &JointTrajectory,
    [begin, end]: [usize; 2],
) -> Option<ArmFault> {
    let (push, heading) = (&step.push, step.push.heading());
    let fault = |speed: f64| ArmFault::Pace { speed, planned: push.speed };
    let duration = path.points[end].time - path.points[begin].time;
    // Ramps of up to two intervals each take twice as long.
    let longest = (push.length + 4.0 * SPACING) / push.speed;
    if duration < push.duration() / (1.0 + EVEN) || duration > longest * (1.0 + EVEN) {
        return Some(fault(push.length / duration));
    }
    (begin..end).find_map(|point| {
        let time = (path.points[point + 1].time - path.points[point].time) / PARTS as f64;
        let along = |k: usize| {
            let at = path.between(point, k as f64 / PARTS as f64);
            (effector(arm, &at).position.xy() - push.start).dot(&heading)
        };
        let along: Vec<f64> = (0..=PARTS).map(along).collect();
        along.windows(2).find_map(|pair| {
            let speed = (pair[1] - pair[0]) / time;
            let (middle, share) = (0.5 * (pair[0] + pair[1]), speed / push.speed);
            let ramp = middle.min(push.length - middle) < 2.0 * SPACING;
            let [low, high] = if ramp { [-EVEN, 1.0 + RAMP] } else { [1.0 - EVEN, 1.0 + EVEN] };
            (share < low || share > high).then(|| fault(speed))
        })
    })
}

/// Returns a fault if the tool, at these poses evenly spaced over `time` seconds, is lowered, drawn
/// back or lifted faster than the planner does and than its push is.
pub(super) fn hasty(step: &PushStep, poses: &[Pose3], time: f64) -> Option<ArmFault> {
    let planned = GENTLE.max(step.push.speed);
    let each = time / (poses.len() - 1) as f64;
    let mut speeds =
        poses.windows(2).map(|pair| (pair[1].position - pair[0].position).norm() / each);
    let speed = speeds.find(|speed| *speed > planned * (1.0 + RAMP))?;
    Some(ArmFault::Pace { speed, planned })
}
