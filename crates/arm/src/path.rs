//! Segments of an arm's path: straight lines of the flange, linear joint motions, and their timing.

use super::model::Arm;
use pushplan::geometry::Pose3;
use pushplan::scene::{ArmFault, JointPoint};

use super::inverse::{NEAR, inverse};
use super::kinematics::{dexterity, flange, frames};

/// Maximum distance of points on a straight line of the flange, metres.
pub(super) const SPACING: f64 = 0.01;

/// Maximum joint motion between two points of a line, radians or metres; larger motion is a jump.
const JUMP: f64 = 0.35;

/// Minimum dexterity along a line, metres per radian: 10 cm/s then need joint speeds of 3 rad/s,
/// which is typical of arms.
pub(super) const DEXTERITY: f64 = 0.03;

/// Share of the joint speed limit used between pushes, and the default speed without a limit,
/// radians or metres per second.
pub(super) const SHARE: f64 = 0.5;
pub(super) const USUAL_SPEED: f64 = 1.0;

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
        joint.limits.is_some_and(|[low, high]| **at - low < 1e-3 || high - **at < 1e-3)
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
        let within = |at: f64| joint.limits.is_none_or(|[low, high]| (low..=high).contains(&at));
        [wanted, wanted + TAU, wanted - TAU, *at].into_iter().find(|at| within(*at)).unwrap_or(*at)
    };
    arm.joints.iter().zip(posture).zip(near).map(turned).collect()
}

/// Trajectory under construction, whose segments start and end at rest.
pub(super) struct Pieces<'a> {
    arm: &'a Arm,
    pub points: Vec<JointPoint>,
}

impl<'a> Pieces<'a> {
    pub fn new(arm: &'a Arm) -> Self {
        Self { arm, points: vec![resting(0.0, &arm.home)] }
    }

    /// Returns the current joint positions.
    pub fn now(&self) -> &[f64] {
        self.points.last().map_or(&self.arm.home, |point| &point.positions)
    }

    /// Appends a linear joint motion to other positions, at half of the speed limits.
    pub fn swing(&mut self, to: &[f64]) {
        let took = |((joint, a), b): ((&crate::model::ArmJoint, &f64), &f64)| {
            let speed = SHARE * joint.max_speed.unwrap_or(USUAL_SPEED / SHARE);
            1.5 * (b - a).abs() / speed
        };
        let longest = self.arm.joints.iter().zip(self.now()).zip(to).map(took).fold(0.0, f64::max);
        if longest > 1e-9 {
            self.points.push(resting(self.time() + longest, to));
        }
    }

    /// Appends the points of a flange line of this length, metres, at a speed, m/s. `gently`
    /// reduces the speed as far as the joint speed limits require.
    pub fn along(&mut self, line: &[Vec<f64>], length: f64, speed: f64, gently: bool) {
        let count = line.len().saturating_sub(1);
        if count == 0 || length <= 0.0 {
            return;
        }
        let mut interval = length / count as f64 / speed;
        if gently {
            for pair in line.windows(2) {
                for ((joint, a), b) in self.arm.joints.iter().zip(&pair[0]).zip(&pair[1]) {
                    let speed = SHARE * joint.max_speed.unwrap_or(USUAL_SPEED / SHARE);
                    interval = interval.max((b - a).abs() / speed);
                }
            }
        }
        // The line accelerates and decelerates within its first and last interval.
        let long = |k: usize| if k == 0 || k + 1 == count { 2.0 * interval } else { interval };
        let begun = self.time();
        let times: Vec<f64> = (0..=count).map(|k| begun + (0..k).map(long).sum::<f64>()).collect();
        for k in 1..=count {
            let mut point = resting(times[k], &line[k]);
            if k < count {
                let time = times[k + 1] - times[k - 1];
                let difference = line[k + 1].iter().zip(&line[k - 1]);
                point.velocities = difference.map(|(a, b)| (a - b) / time).collect();
            }
            self.points.push(point);
        }
    }

    fn time(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.time)
    }
}

fn resting(time: f64, positions: &[f64]) -> JointPoint {
    JointPoint { time, positions: positions.to_vec(), velocities: vec![0.0; positions.len()] }
}

/// Returns the pose of the flange for joint positions.
pub(super) fn flange_at(arm: &Arm, positions: &[f64]) -> Pose3 {
    flange(arm, &frames(arm, positions))
}
