//! Segments of an arm's path: straight lines of the flange, and shifts of joints by whole turns.

use super::model::Arm;
use pushplan::geometry::Pose3;
use pushplan::scene::ArmFault;

use super::inverse::{NEAR, inverse};
use super::kinematics::{dexterity, flange, frames};

/// Maximum distance of points on a straight line of the flange, metres.
pub(super) const SPACING: f64 = 0.01;

/// Maximum joint motion between two points of a line, radians or metres; larger motion is a jump.
const JUMP: f64 = 0.35;

/// Minimum dexterity along a line, metres per radian: 10 cm/s then need joint speeds of 3 rad/s,
/// which is typical of arms.
pub(super) const DEXTERITY: f64 = 0.03;

/// Share of the joint limits used between pushes.
pub(super) const SHARE: f64 = 0.5;

/// Speed of lowering and lifting tools, m/s.
pub(super) const GENTLE: f64 = 0.1;

/// Computes joint positions along a straight line of the flange, from the configuration `start` at
/// its beginning.
pub(super) fn line(
    arm: &Arm,
    [from, to]: [&Pose3; 2],
    start: &[f64],
) -> (Vec<Vec<f64>>, Option<ArmFault>) {
    let steps = ((to.position - from.position).norm() / SPACING - 1e-6).ceil().max(1.0) as usize;
    let mut points = vec![start.to_vec()];
    for step in 1..=steps {
        let share = step as f64 / steps as f64;
        let target = Pose3 {
            position: from.position.lerp(&to.position, share),
            rotation: from.rotation.slerp(&to.rotation, share),
        };
        let before = &points[step - 1];
        let found = inverse(arm, &target, before, NEAR);
        let near = |found: &Vec<f64>| found.iter().zip(before).all(|(a, b)| (a - b).abs() <= JUMP);
        let Some(found) = found.filter(near) else {
            let fault = why(arm, before);
            return (points, Some(fault));
        };
        if dexterity(arm, &frames(arm, &found)) < DEXTERITY {
            return (points, Some(ArmFault::Singular));
        }
        points.push(found);
    }
    (points, None)
}

/// Returns the reason why the joints cannot continue from their positions.
pub(super) fn why(arm: &Arm, at: &[f64]) -> ArmFault {
    let ended = arm.joints.iter().zip(at).find(|(joint, at)| {
        joint.range().is_some_and(|[low, high]| **at - low < 1e-3 || high - **at < 1e-3)
    });
    match ended {
        Some((joint, _)) => ArmFault::Limit { joint: joint.name.clone() },
        None if dexterity(arm, &frames(arm, at)) < 2.0 * DEXTERITY => ArmFault::Singular,
        None => ArmFault::Unreachable,
    }
}

/// Shifts joints by whole turns so that a configuration is as near to another as the limits allow.
pub(super) fn unwound(arm: &Arm, posture: &[f64], near: &[f64]) -> Vec<f64> {
    use std::f64::consts::TAU;
    let turned = |((joint, at), near): ((&crate::model::ArmJoint, &f64), &f64)| {
        if joint.slides {
            return *at;
        }
        let wanted = at + ((near - at) / TAU).round() * TAU;
        let within = |at: f64| joint.range().is_none_or(|[low, high]| (low..=high).contains(&at));
        [wanted, wanted + TAU, wanted - TAU, *at].into_iter().find(|at| within(*at)).unwrap_or(*at)
    };
    arm.joints.iter().zip(posture).zip(near).map(turned).collect()
}

/// Returns the pose of the flange for joint positions.
pub(super) fn flange_at(arm: &Arm, positions: &[f64]) -> Pose3 {
    flange(arm, &frames(arm, positions))
}
