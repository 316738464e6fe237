//! Forward kinematics and Jacobian.

use nalgebra::{Matrix6, Matrix6xX, Vector6};

use super::model::Arm;
use pushplan::geometry::{Pose3, Vector3};

/// Lever arm that weights rotations against translations, metres: about the distance of a tool's
/// parts from the flange.
const LEVER: f64 = 0.2;

/// Returns the world frames of the bodies of an arm: the base, then the body of each joint.
pub fn frames(arm: &Arm, positions: &[f64]) -> Vec<Pose3> {
    let mut frames = Vec::with_capacity(arm.joints.len() + 1);
    let mut frame = arm.base;
    frames.push(frame);
    for (joint, position) in arm.joints.iter().zip(positions) {
        frame = frame * joint.pose(*position);
        frames.push(frame);
    }
    frames
}

/// Returns the pose of the flange.
pub fn flange(arm: &Arm, frames: &[Pose3]) -> Pose3 {
    frames.last().map_or(arm.base, |last| *last * arm.flange)
}

/// Returns the Jacobian of the flange in world axes: translations, then rotations.
pub(super) fn jacobian(arm: &Arm, frames: &[Pose3], at: Vector3) -> Matrix6xX<f64> {
    let mut found = Matrix6xX::zeros(arm.joints.len());
    for (k, joint) in arm.joints.iter().enumerate() {
        let axis = frames[k + 1].rotation * joint.axis;
        let (shift, turn) = match joint.slides {
            true => (axis, Vector3::zeros()),
            false => (axis.cross(&(at - frames[k + 1].position)), axis),
        };
        found.fixed_view_mut::<3, 1>(0, k).copy_from(&shift);
        found.fixed_view_mut::<3, 1>(3, k).copy_from(&turn);
    }
    found
}

/// Returns the twist between two poses: translation, metres, and rotation vector, radians.
pub(super) fn twist(from: &Pose3, to: &Pose3) -> Vector6<f64> {
    let shift = to.position - from.position;
    let turn = (to.rotation * from.rotation.inverse()).scaled_axis();
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

/// Returns the smallest singular value of the Jacobian, metres per radian, with rotations weighted
/// by a lever arm of 20 cm. The value is zero at a singular configuration.
pub fn dexterity(arm: &Arm, frames: &[Pose3]) -> f64 {
    let mut jacobian = jacobian(arm, frames, flange(arm, frames).position);
    jacobian.rows_mut(3, 3).scale_mut(LEVER);
    let square: Matrix6<f64> = &jacobian * jacobian.transpose();
    square.symmetric_eigenvalues().min().max(0.0).sqrt()
}
