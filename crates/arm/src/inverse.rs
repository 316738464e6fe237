//! Inverse kinematics by damped least squares (Wampler 1986, doi:10.1109/TSMC.1986.289285), with
//! damping by the remaining error (Sugihara 2011, doi:10.1109/TRO.2011.2148230).
//!
//! Joints at their limits are fixed while the others continue. Redundant revolute joints move
//! towards the middle of their limits. They move less if they are slow, such as a lift, or near a
//! limit (Chan and Dubey 1995, doi:10.1109/70.370511). An arm with fewer than six joints may be
//! unable to remove a small tilt of the tool, which comes from rounded numbers in its file. The
//! tilt is minimized, while position and rotation about the vertical are exact.

use std::f64::consts::PI;

use nalgebra::{DVector, Matrix6, Matrix6xX, Vector6};

use super::model::{Arm, ArmJoint};
use pushplan::geometry::Pose3;

use super::kinematics::{flange, frames, jacobian, twist};

/// Position and rotation tolerance of convergence, metres and radians.
const SHIFT: f64 = 1e-7;
const TURN: f64 = 1e-6;

/// Maximum tilt that may remain if no joint reduces it, radians.
const TILT: f64 = 2e-3;

/// Weight of the tilt near the target, and the error at which it begins, metres and radians.
const LIGHT: f64 = 1e-3;
const NEARBY: f64 = 1e-2;

/// Maximum joint motion in one iteration, radians or metres.
const STRIDE: f64 = 0.4;

/// Share of the way to their middle that redundant joints move in the first iteration.
const SPARE: f64 = 0.02;

/// Share of the range near each limit in which redundant joints slow down, and the least weight.
const SLOW: f64 = 0.1;
const SLOWEST: f64 = 0.05;

/// Maximum number of iterations from a near and from an arbitrary configuration.
pub(super) const NEAR: usize = 15;
pub(super) const ANYWHERE: usize = 60;

/// Number of additional starts, and minimum distance of distinct configurations, radians or metres.
const STARTS: usize = 24;
const APART: f64 = 0.1;

/// Computes joint positions that bring the flange to a pose, near `seed`. Returns `None` if the
/// solver finds none within `rounds` iterations.
pub fn inverse(arm: &Arm, target: &Pose3, seed: &[f64], rounds: usize) -> Option<Vec<f64>> {
    let mut at = seed.to_vec();
    keep(arm, &mut at);
    let redundant = at.len() > 6 || arm.joints.iter().any(|joint| joint.slides);
    let mut tilt_before = f64::INFINITY;
    for round in 0..=rounds {
        let frames = frames(arm, &at);
        let here = flange(arm, &frames);
        let mut left = twist(&here, target);
        let tilt = left.fixed_rows::<2>(3).norm();
        let upright = tilt < TURN || tilt < TILT && tilt > 0.9 * tilt_before;
        if left.fixed_rows::<3>(0).norm() < SHIFT && left[5].abs() < TURN && upright {
            return Some(at);
        }
        if round == rounds {
            break;
        }
        tilt_before = tilt;
        let mut jacobian = jacobian(arm, &frames, here.position);
        if left.norm() < NEARBY {
            jacobian.rows_mut(3, 2).scale_mut(LIGHT);
            left.rows_mut(3, 2).scale_mut(LIGHT);
        }
        let weights: Vec<f64> =
            arm.joints.iter().zip(&at).map(|(joint, at)| weight(joint, *at)).collect();
        let weighted = |jacobian: &Matrix6xX<f64>, twist: &Vector6<f64>| {
            if !redundant {
                return solved(jacobian, twist);
            }
            let mut scaled = jacobian.clone();
            scaled.column_iter_mut().zip(&weights).for_each(|(mut column, w)| column *= *w);
            let mut step = solved(&scaled, twist);
            step.iter_mut().zip(&weights).for_each(|(step, w)| *step *= w);
            step
        };
        let mut step = DVector::zeros(at.len());
        // Joints that would leave their limits are excluded, and the rest solves the step.
        for _ in 0..3 {
            step = weighted(&jacobian, &left);
            let mut held = false;
            for k in 0..at.len() {
                if let Some([low, high]) = arm.joints[k].range()
                    && jacobian.column(k).norm_squared() > 0.0
                    && (at[k] <= low && step[k] < 0.0 || at[k] >= high && step[k] > 0.0)
                {
                    jacobian.column_mut(k).fill(0.0);
                    held = true;
                }
            }
            if !held {
                break;
            }
        }
        if round == 0 && at.len() > 6 {
            // A lift remains at its height where the other joints suffice.
            let wish = |k: usize, _| match arm.joints[k].slides {
                true => 0.0,
                false => SPARE * (arm.joints[k].middle() - at[k]),
            };
            let wish = DVector::from_fn(at.len(), wish);
            // The null-space motion does not move the flange.
            step += &wish - weighted(&jacobian, &(&jacobian * &wish));
        }
        let largest = step.amax();
        if !largest.is_finite() {
            return None;
        }
        let share = if largest > STRIDE { STRIDE / largest } else { 1.0 };
        at.iter_mut().zip(step.iter()).for_each(|(at, step)| *at += share * step);
        keep(arm, &mut at);
    }
    None
}

/// Returns the distinct configurations found from the given seeds.
pub(super) fn near(arm: &Arm, target: &Pose3, seeds: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let found = seeds.iter().filter_map(|seed| inverse(arm, target, seed, ANYWHERE));
    let mut found: Vec<Vec<f64>> = found.collect();
    found.dedup_by(|a, b| away(a, b) <= APART);
    found
}

/// Returns the largest difference of joint positions.
fn away(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns the configurations that bring the flange to a pose: those found from `seeds`, then
/// others, nearest to the first seed first.
pub fn postures(arm: &Arm, target: &Pose3, seeds: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    let add = |found: &mut Vec<Vec<f64>>, seed: &[f64]| {
        if let Some(posture) = inverse(arm, target, seed, ANYWHERE)
            && found.iter().all(|known| away(known, &posture) > APART)
        {
            found.push(posture);
        }
    };
    seeds.iter().for_each(|seed| add(&mut found, seed));
    let given = found.len();
    (0..STARTS).for_each(|index| add(&mut found, &start(arm, index)));
    if let Some(first) = seeds.first() {
        found[given..].sort_by(|a, b| away(a, first).total_cmp(&away(b, first)));
    }
    found
}

/// Returns joint positions of a Kronecker sequence within the limits, evenly distributed and
/// deterministic. Rotations by more than one turn repeat the same configurations.
pub(super) fn start(arm: &Arm, index: usize) -> Vec<f64> {
    let spans = arm.joints.iter().map(|joint| {
        let [low, high] = joint.limits.unwrap_or([-PI, PI]);
        let low = low.max(-PI);
        [low, high.min(PI).max(low)]
    });
    kronecker(&spans.collect::<Vec<_>>(), index)
}

/// Returns the point with an index of the Kronecker sequence within spans.
pub(super) fn kronecker(spans: &[[f64; 2]], index: usize) -> Vec<f64> {
    // The shares are powers of the positive root of x^(d+1) = x + 1.
    let d = spans.len() as i32;
    let mut root: f64 = 1.5;
    for _ in 0..40 {
        root = (1.0 + root).powf(1.0 / f64::from(d + 1));
    }
    let share = |k: usize| (0.5 + (index + 1) as f64 * root.powi(-(k as i32 + 1))).fract();
    spans.iter().enumerate().map(|(k, [low, high])| low + share(k) * (high - low)).collect()
}

/// Returns the smallest joint step for a twist, damped by its magnitude.
fn solved(jacobian: &Matrix6xX<f64>, twist: &Vector6<f64>) -> DVector<f64> {
    let damping = 1e-3 * twist.norm_squared().min(1.0) + 1e-10;
    let mut square: Matrix6<f64> = jacobian * jacobian.transpose();
    for k in 0..6 {
        square[(k, k)] += damping;
    }
    match square.cholesky() {
        Some(factor) => jacobian.transpose() * factor.solve(twist),
        None => DVector::zeros(jacobian.ncols()),
    }
}

/// Returns the weight of a redundant joint: 1, and less if it is slow or near its limits.
fn weight(joint: &ArmJoint, at: f64) -> f64 {
    let fast = joint.speed().min(1.0);
    let Some([low, high]) = joint.range() else { return fast };
    let near = (at - low).min(high - at) / (SLOW * (high - low));
    let near = near.clamp(0.0, 1.0);
    fast * (SLOWEST + (1.0 - SLOWEST) * near * near * (3.0 - 2.0 * near))
}

/// Clamps joint positions to the range that the planner keeps.
fn keep(arm: &Arm, at: &mut [f64]) {
    for (joint, at) in arm.joints.iter().zip(at) {
        if let Some([low, high]) = joint.range() {
            *at = at.clamp(low, high);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ArmBody, ToolMount};
    use crate::places::Places;
    use pushplan::geometry::{Turn3, Vector3};

    /// Returns an arm with six joints and two links of 0.3 m.
    fn arm() -> Arm {
        let joint = |at: [f64; 3], axis: Vector3| ArmJoint {
            name: "j".into(),
            slides: false,
            origin: Pose3 { position: Vector3::from(at), ..Pose3::default() },
            axis,
            limits: Some([-2.8, 2.8]),
            max_speed: Some(2.0),
            max_acceleration: None,
            max_jerk: None,
        };
        let (y, z) = (Vector3::y(), Vector3::z());
        let joints = vec![
            joint([0.0, 0.0, 0.2], z),
            joint([0.0, 0.0, 0.1], y),
            joint([0.0, 0.0, 0.3], y),
            joint([0.0, 0.0, 0.15], z),
            joint([0.0, 0.0, 0.15], y),
            joint([0.0, 0.0, 0.05], z),
        ];
        let body = |_| ArmBody { name: "b".into(), solids: Vec::new() };
        Arm {
            name: "test".into(),
            base: Pose3::default(),
            bodies: (0..7).map(body).collect(),
            home: vec![0.0; joints.len()],
            joints,
            beside: Vec::new(),
            pairs: Vec::new(),
            flange: Pose3::default(),
            mount: ToolMount { length: 0.1, yaw: 0.0 },
            places: Places::default(),
        }
    }

    #[test]
    fn inverse_kinematics_inverts_joints_within_limits() {
        let arm = arm();
        let mut solved = 0;
        for index in 0..60 {
            let there = start(&arm, index);
            let target = flange(&arm, &frames(&arm, &there));
            let near: Vec<f64> = there.iter().map(|at| at + 0.05).collect();
            let found = inverse(&arm, &target, &near, ANYWHERE);
            let Some(found) = found else { continue };
            solved += 1;
            let off = twist(&flange(&arm, &frames(&arm, &found)), &target);
            assert!(off.norm() < 1e-5, "{off}");
            assert!(found.iter().all(|at| at.abs() <= 2.8));
        }
        assert!(solved >= 55, "{solved}");
        let far = Pose3 { position: Vector3::new(2.0, 0.0, 0.3), rotation: Turn3::identity() };
        assert!(postures(&arm, &far, &[vec![0.0; 6]]).is_empty());
    }

    #[test]
    fn a_reachable_pose_has_several_postures() {
        // This pose, with the tool down and aligned axes, needs a last joint that rotates by more
        // than 2.8.
        let mut arm = arm();
        arm.joints.iter_mut().for_each(|joint| joint.limits = None);
        let down = Turn3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
        let target = Pose3 { position: Vector3::new(0.35, 0.1, 0.25), rotation: down };
        let found = postures(&arm, &target, &[vec![0.3, 0.5, 1.0, 0.0, 1.5, 0.0]]);
        assert!(found.len() >= 3, "{}", found.len());
    }
}
