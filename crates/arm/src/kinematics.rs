//! Forward kinematics and Jacobian.

use nalgebra::{Matrix2, Matrix4, Matrix4xX, Matrix6xX, Vector6};

use super::model::Arm;
use pushplan::geometry::{Pose3, Vector3};

/// Lever arm that weights rotations against translations, metres: about the distance of a tool's
/// parts from the flange.
const LEVER: f64 = 0.2;

/// Motion per unit of a joint below which a joint counts as horizontal.
const LEVEL: f64 = 1e-6;

/// Tilt per radian of a joint below which it is not counteracted: axes in files are rounded.
const LEAST_TILT: f64 = 0.02;

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

/// Returns the height of the tool's underside above its height in a push, metres, for an arm whose
/// joints all move horizontally; `None` for other arms.
pub(super) fn level(arm: &Arm, frames: &[Pose3], lift: f64) -> Option<f64> {
    let at = flange(arm, frames);
    let jacobian = jacobian(arm, frames, at.position);
    let down = (at.rotation * Vector3::z()).z < -1.0 + LEVEL;
    let moves = jacobian.rows(2, 3).amax();
    (moves < LEVEL && down).then(|| at.position.z - arm.mount.length - lift)
}

/// Returns the smallest speed of the tool in any direction that pushing needs, for joints that move
/// at one radian per second, metres per radian. These directions are the position in the plane, the
/// height, and the rotation about the vertical, weighted by a lever arm of 20 cm. The tool must not
/// tilt meanwhile. The value is zero at a singular configuration.
///
/// The height does not count for an arm whose joints all move horizontally.
pub fn dexterity(arm: &Arm, frames: &[Pose3]) -> f64 {
    let mut jacobian = jacobian(arm, frames, flange(arm, frames).position);
    let tilts = jacobian.fixed_rows::<2>(3).into_owned();
    let level = jacobian.row(2).amax().max(tilts.amax()) < LEVEL;
    jacobian.row_mut(5).scale_mut(LEVER);
    // Rows: two for the plane, height, rotation.
    let moves = Matrix4xX::from_rows(&[0, 1, 2, 5].map(|row| jacobian.row(row).into_owned()));
    let square = tilts.clone() * tilts.transpose() + Matrix2::identity() * LEAST_TILT.powi(2);
    let across = &moves * tilts.transpose();
    let held =
        square.try_inverse().map_or(Matrix4::zeros(), |one| across * one * across.transpose());
    let mut free: Matrix4<f64> = &moves * moves.transpose() - held;
    if level {
        free[(2, 2)] = 1.0;
    }
    free.symmetric_eigenvalues().min().max(0.0).sqrt()
}
