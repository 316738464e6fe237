//! Conversion of spatial poses to and from rapier, whose origin is on the table.

use rapier3d_f64::prelude::{Pose3 as RapierPose, Rotation, Vector as RapierVector};

use crate::geometry::{Pose3, Vector, Vector3};

/// Returns the quaternion of the rotation with the sign nearer to `last`. Between opposite signs
/// rapier computes a full rotation within a step, which throws the plate off at tens of metres a
/// second.
pub(super) fn in_one_hemisphere(last: Rotation, next: Rotation) -> Rotation {
    if last.dot(next) < 0.0 { -next } else { next }
}

pub(super) fn to_rapier(pose: &Pose3, origin: Vector) -> RapierPose {
    let ([x, y, z], [i, j, k, w]) = (pose.position.into(), pose.quaternion());
    let position = RapierVector::new(x - origin.x, y - origin.y, z);
    RapierPose::from_parts(position, Rotation::from_xyzw(i, j, k, w))
}

pub(super) fn from_rapier(pose: &RapierPose, origin: Vector) -> Pose3 {
    let (p, q) = (pose.translation, pose.rotation);
    let position = Vector3::new(p.x + origin.x, p.y + origin.y, p.z);
    Pose3::from_quaternion(position, q.to_array())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_keep_their_sign() {
        let turn = Rotation::from_rotation_y(0.3);
        let next = Rotation::from_rotation_y(0.31);
        assert_eq!(in_one_hemisphere(turn, -next), next);
        assert_eq!(in_one_hemisphere(turn, next), next);
        assert_eq!(in_one_hemisphere(-turn, next), -next);
    }
}
