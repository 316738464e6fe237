//! Contact points of two cuboids with 3-D poses that touch or are close.

use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector as ParryVector};
use parry3d_f64::query::ContactManifold;
use parry3d_f64::query::details::contact_manifold_cuboid_cuboid;
use parry3d_f64::shape::Cuboid;

use super::{Pose3, Vector3};

/// A cuboid about its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3 {
    /// Pose of the centre.
    pub pose: Pose3,
    /// Half extents, metres.
    pub half: Vector3,
}

/// A point at which two cuboids are near each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxContact {
    /// The point on the first, metres.
    pub point: Vector3,
    /// Unit normal, from the second to the first.
    pub normal: Vector3,
    /// Distance along the normal, metres; negative where the cuboids overlap.
    pub gap: f64,
}

impl Box3 {
    /// Returns `true` if the other cuboid may be within `reach` metres, judged by the face normals
    /// of this one only. Never returns `false` wrongly.
    fn is_near(&self, other: &Self, reach: f64) -> bool {
        let away = self.pose.rotation.inverse() * (other.pose.position - self.pose.position);
        let turn = (self.pose.rotation.inverse() * other.pose.rotation).to_rotation_matrix();
        let extents = turn.matrix().abs() * other.half;
        (0..3).all(|k| away[k].abs() <= self.half[k] + extents[k] + reach)
    }

    /// Calls `found` for every contact with `other` whose gap is at most `reach` metres.
    ///
    /// Contacts are corners against a face, or the nearest points of two edges, along the direction
    /// of the largest separation or the least penetration (parry's separating axes).
    pub fn contacts(&self, other: &Self, reach: f64, mut found: impl FnMut(BoxContact)) {
        if !other.is_near(self, reach) || !self.is_near(other, reach) {
            return;
        }
        let between = to_parry(&(self.pose.inverse() * other.pose));
        let shape = |half: Vector3| Cuboid::new(ParryVector::new(half.x, half.y, half.z));
        let mut manifold = ContactManifold::<(), ()>::new();
        let (own, its) = (shape(self.half), shape(other.half));
        contact_manifold_cuboid_cuboid(&between, &own, &its, reach, &mut manifold);
        let normal = -(self.pose.rotation * from_parry(manifold.local_n1));
        for point in &manifold.points {
            let at = self.pose.point(from_parry(point.local_p1));
            found(BoxContact { point: at, normal, gap: point.dist });
        }
    }
}

fn to_parry(pose: &Pose3) -> ParryPose {
    let ([x, y, z], [i, j, k, w]) = (pose.position.into(), pose.quaternion());
    ParryPose::from_parts(ParryVector::new(x, y, z), Rotation::from_xyzw(i, j, k, w))
}

fn from_parry(v: ParryVector) -> Vector3 {
    Vector3::new(v.x, v.y, v.z)
}

#[cfg(test)]
mod tests;
