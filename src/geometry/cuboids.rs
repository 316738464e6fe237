//! Where two cuboids in space touch, or soon would.

use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector as ParryVector};
use parry3d_f64::query::ContactManifold;
use parry3d_f64::query::details::contact_manifold_cuboid_cuboid;
use parry3d_f64::shape::Cuboid;

use super::{Pose3, Vector3};

/// A cuboid about its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3 {
    /// Where its centre is, and how it is turned.
    pub pose: Pose3,
    /// Half its extents, metres.
    pub half: Vector3,
}

/// A point at which two cuboids are near each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxContact {
    /// The point on the first, metres.
    pub point: Vector3,
    /// Unit normal, from the second to the first.
    pub normal: Vector3,
    /// Distance along it, metres; negative where they are in each other.
    pub gap: f64,
}

impl Box3 {
    /// Whether it may come within `reach` metres of another; never wrongly no: by the normals of the
    /// faces of this one alone.
    fn is_near(&self, other: &Self, reach: f64) -> bool {
        let away = self.pose.rotation.inverse() * (other.pose.position - self.pose.position);
        let turn = (self.pose.rotation.inverse() * other.pose.rotation).to_rotation_matrix();
        let extents = turn.matrix().abs() * other.half;
        (0..3).all(|k| away[k].abs() <= self.half[k] + extents[k] + reach)
    }

    /// Tells `found` of the contacts with `other` whose gap is at most `reach` metres: corners
    /// against a face, or the nearest points of two edges, along the direction in which they are
    /// farthest apart or least deep in each other (parry's separating axes).
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
mod tests {
    use super::*;
    use crate::geometry::Pose;

    fn cuboid(at: [f64; 3], half: [f64; 3]) -> Box3 {
        Box3 { pose: Pose3 { position: at.into(), ..Pose3::default() }, half: half.into() }
    }

    fn contacts(a: &Box3, b: &Box3, reach: f64) -> Vec<BoxContact> {
        let mut found = Vec::new();
        a.contacts(b, reach, |contact| found.push(contact));
        found
    }

    #[test]
    fn a_cuboid_stands_on_another_with_four_corners() {
        let (floor, on) =
            (cuboid([0.0; 3], [0.1, 0.1, 0.01]), cuboid([0.0, 0.0, 0.021], [0.01; 3]));
        let found = contacts(&on, &floor, 0.005);
        assert_eq!(found.len(), 4);
        for contact in found {
            assert!((contact.normal - Vector3::z()).norm() < 1e-12);
            assert!((contact.gap - 0.001).abs() < 1e-12);
            assert!((contact.point.z - 0.011).abs() < 1e-12);
        }
        assert_eq!(contacts(&on, &floor, 0.0005), []);
    }

    #[test]
    fn crossed_edges_touch_in_one_point() {
        // Both turned about their edges so that these face each other, one along x, one along y.
        let eighth = std::f64::consts::FRAC_PI_4;
        let turned = |at: Vector3, axis| {
            Box3 {
                pose: Pose3::upright(Pose::default(), 0.0).turned_about(
                    Vector3::zeros(),
                    axis,
                    eighth,
                ),
                half: Vector3::repeat(0.01),
            }
            .at(at)
        };
        let below = turned(Vector3::zeros(), Vector3::x_axis());
        let above = turned(Vector3::new(0.0, 0.0, 0.03), Vector3::y_axis());
        let found = contacts(&above, &below, 0.002);
        let contact = found.iter().min_by(|a, b| a.gap.total_cmp(&b.gap)).expect("a contact");
        assert!((contact.gap - (0.03 - 0.02 * 2f64.sqrt())).abs() < 1e-9, "{}", contact.gap);
        assert!((contact.normal - Vector3::z()).norm() < 1e-9);
    }

    impl Box3 {
        fn at(mut self, at: Vector3) -> Self {
            self.pose.position = at;
            self
        }
    }
}
