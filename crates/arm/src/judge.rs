//! Check whether a joint trajectory executes a plan, by forward kinematics from its numbers only.

use std::sync::Arc;

use super::model::Arm;
use pushplan::geometry::{Pose3, Vector3};
use pushplan::scene::{ArmFault, JointTrajectory, Scene, State, Tool};
use pushplan::task::{Plan, Push, PushForm, PushStep};

use super::kinematics::{dexterity, flange, frames};
use super::pace::{hasty, uneven, unrested};
use super::path::DEXTERITY;
use super::room::Room;
use super::strain::{self, SHARES, Strain};

/// Tolerance of the tool pose during a push, and the lever arm that weights rotations, metres.
const OFF: f64 = 1e-3;
const ARM: f64 = 0.1;

/// Interval of checks on joint motion, radians or metres.
const LOOK: f64 = 0.05;

/// Factor by which rounding may reduce the dexterity.
const NEARER: f64 = 0.9;

/// Checks a joint trajectory against a plan and an arm, and returns the first fault of every push.
/// `states` are the states before the first push and after each, as far as they are known.
pub fn judge(
    (arm, scene): (&Arm, &Scene),
    tool: &Arc<Tool>,
    plan: &Plan,
    states: &[State],
    path: &JointTrajectory,
) -> Vec<(usize, ArmFault)> {
    let steps: Vec<&PushStep> = plan.push_steps().collect();
    let names = arm.joints.iter().map(|joint| &joint.name);
    if path.fault().is_some()
        || !names.eq(&path.joints)
        || path.pushes.len() != steps.len()
        || path.points.is_empty()
    {
        return vec![(0, ArmFault::OfAnother)];
    }
    if let Some(fault) = unrested(arm, path) {
        return vec![(0, fault)];
    }
    let room = Room::new(arm, scene, Some(tool));
    let ends = |k: usize| path.pushes.get(k).map_or(path.points.len() - 1, |push| push[1]);
    let mut found = Vec::new();
    for (k, step) in steps.iter().enumerate() {
        // A push includes the motion to its start, and the last push also includes the motion after
        // it.
        let from = if k == 0 { 0 } else { path.pushes[k - 1][1] };
        let to = if k + 1 == steps.len() { path.points.len() - 1 } else { ends(k) };
        let [begin, end] = path.pushes[k];
        let start = PushStep { push: Push { length: 0.0, ..step.push }, ..(*step).clone() };
        let before = [&steps[k.saturating_sub(1)..k], &[&start]].concat();
        let fault = (from..to).find_map(|point| {
            let pushing = (begin..end).contains(&point);
            let moved = point >= begin.midpoint(end);
            let state = states.get(k + usize::from(moved)).or(states.last());
            let objects = state.map(|state| room.objects(state)).unwrap_or_default();
            let samples = samples(path, point);
            let time = path.points[point + 1].time - path.points[point].time;
            // The tool is drawn back along the last push, and lowered at the start of the next.
            let beside = if point < begin { &before[..] } else { &steps[k..=k] };
            let lowered = lowered(arm, beside, &samples).filter(|_| !pushing);
            pushing
                .then(|| off(arm, step, &samples))
                .flatten()
                .or_else(|| limits(arm, path, point, (&samples, pushing)))
                .or_else(|| lowered.as_ref().and_then(|(step, poses)| hasty(step, poses, time)))
                .or_else(|| {
                    let carried = (!pushing && lowered.is_none()).then_some(0.0);
                    let met = |at: &Vec<f64>| room.met(&room.stance(at), &objects, carried);
                    let between = samples.iter().find_map(met)?;
                    Some(ArmFault::Collides { between })
                })
        });
        let fault = fault
            .or_else(|| ends_off(arm, step, path, k))
            .or_else(|| uneven(arm, step, path, [begin, end]));
        found.extend(fault.map(|fault| (k, fault)));
    }
    let parted = |k: &usize| {
        steps[*k].form == PushForm::Chained && path.pushes[k - 1][1] != path.pushes[*k][0]
    };
    found.extend((1..steps.len()).filter(parted).map(|k| (k, ArmFault::OfAnother)));
    found
}

/// Returns joint positions sampled from a point to the next, both included.
fn samples(path: &JointTrajectory, point: usize) -> Vec<Vec<f64>> {
    let [a, b] = [&path.points[point].positions, &path.points[point + 1].positions];
    let far = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // Joints that leave or arrive faster than on a straight way also turn around between.
    let [from, to] = [&path.points[point], &path.points[point + 1]];
    let speeds = from.velocities.iter().chain(&to.velocities);
    let turned = speeds.fold(0.0, |most: f64, v| most.max(v.abs())) * (to.time - from.time) / 3.0;
    let far = far.max(turned);
    let count = (far / LOOK).ceil().clamp(2.0, 1000.0) as usize;
    (0..=count).map(|k| path.between(point, k as f64 / count as f64)).collect()
}

/// Checks the limits of positions, speeds, accelerations and jerks.
fn limits(
    arm: &Arm,
    path: &JointTrajectory,
    point: usize,
    (samples, pushing): (&[Vec<f64>], bool),
) -> Option<ArmFault> {
    let count = samples.len().max(SHARES.len()) - 1;
    let shares: Vec<f64> = (0..=count).map(|k| k as f64 / count as f64).collect();
    let mut found = Strain::default();
    strain::add(arm, path, point, &shares, (1.0, pushing), &mut found);
    found.fault(arm)
}

/// Returns the pose of the end effector, at the tool's underside, for joint positions.
pub(super) fn effector(arm: &Arm, at: &[f64]) -> Pose3 {
    flange(arm, &frames(arm, at)) * arm.flange_of_tool().inverse()
}

/// Returns the push on whose line the tool is lowered, drawn back or lifted, and its poses there;
/// `None` if it is carried elsewhere, where it must touch nothing.
fn lowered<'a>(
    arm: &Arm,
    steps: &[&'a PushStep],
    samples: &[Vec<f64>],
) -> Option<(&'a PushStep, Vec<Pose3>)> {
    let poses: Vec<Pose3> = samples.iter().map(|at| effector(arm, at)).collect();
    let on_line = |step: &&&PushStep| {
        let off = |pose: &Pose3| off_line(step, pose, pose.position.z.max(step.lift));
        poses.iter().all(|pose| off(pose) <= OFF)
    };
    let step = *steps.iter().find(on_line)?;
    Some((step, poses))
}

/// Returns the deviation of a pose from the line of a push at a height, metres.
fn off_line(step: &PushStep, pose: &Pose3, height: f64) -> f64 {
    let push = &step.push;
    let along = (pose.position.xy() - push.start).dot(&push.heading()).clamp(0.0, push.length);
    let nearest = push.start + along * push.heading();
    off_pose(step, pose, Vector3::new(nearest.x, nearest.y, height))
}

/// Returns the deviation of a pose from a position and the grip of a push, metres.
fn off_pose(step: &PushStep, pose: &Pose3, position: Vector3) -> f64 {
    let held = Pose3::upright(pushplan::geometry::Pose::new(0.0, 0.0, step.grip_yaw), 0.0);
    (pose.position - position).norm() + ARM * pose.angle_to(&held)
}

/// Checks that the tool follows its push, away from singular configurations.
fn off(arm: &Arm, step: &PushStep, samples: &[Vec<f64>]) -> Option<ArmFault> {
    samples.iter().find_map(|at| {
        let distance = off_line(step, &effector(arm, at), step.lift);
        if distance > OFF {
            return Some(ArmFault::Off { distance });
        }
        (dexterity(arm, &frames(arm, at)) < NEARER * DEXTERITY).then_some(ArmFault::Singular)
    })
}

/// Checks the start and the end of a push.
fn ends_off(arm: &Arm, step: &PushStep, path: &JointTrajectory, k: usize) -> Option<ArmFault> {
    let push = &step.push;
    let ends = path.pushes[k].into_iter().zip([push.start, push.end()]);
    ends.into_iter().find_map(|(point, end)| {
        let pose = effector(arm, &path.points[point].positions);
        let distance = off_pose(step, &pose, Vector3::new(end.x, end.y, step.lift));
        (distance > OFF).then_some(ArmFault::Off { distance })
    })
}
