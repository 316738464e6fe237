//! 3-D poses, for objects levered off the table.

use std::ops::Mul;

use nalgebra::{Unit, UnitQuaternion};
use serde::{Deserialize, Serialize};

use super::Pose;

/// A 3-D vector or position, metres.
pub type Vector3 = nalgebra::Vector3<f64>;

/// A linear map of 3-D vectors.
pub type Matrix3 = nalgebra::Matrix3<f64>;

/// A 3-D rotation.
pub type Turn3 = UnitQuaternion<f64>;

/// A rigid 3-D pose: rotation by `rotation`, then translation by `position`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose3 {
    /// Position of the body's centre, metres.
    pub position: Vector3,
    /// Rotation relative to the world axes.
    pub rotation: UnitQuaternion<f64>,
}

impl Default for Pose3 {
    fn default() -> Self {
        Self { position: Vector3::zeros(), rotation: UnitQuaternion::identity() }
    }
}

impl Pose3 {
    /// Creates a pose from its position, metres, and the quaternion `x, y, z, w` of its rotation,
    /// which need not be normalised but must not be zero.
    pub fn from_quaternion(position: Vector3, [x, y, z, w]: [f64; 4]) -> Self {
        let rotation = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        Self { position, rotation }
    }

    /// Creates a pose from its position, metres, and approximate directions of its x- and z-axes;
    /// the z-axis is kept. Zero or parallel axes give the identity rotation.
    pub fn from_axes(position: Vector3, x: Vector3, z: Vector3) -> Self {
        let unit = |v: Vector3| v.try_normalize(1e-9);
        let axes = unit(z).and_then(|z| unit(x - z * z.dot(&x)).map(|x| [x, z.cross(&x), z]));
        let rotation = axes.map_or_else(UnitQuaternion::identity, |axes| {
            UnitQuaternion::from_basis_unchecked(&axes)
        });
        Self { position, rotation }
    }

    /// Returns the quaternion of the rotation: `x, y, z, w`.
    pub fn quaternion(&self) -> [f64; 4] {
        self.rotation.coords.into()
    }

    /// Creates an upright pose from a planar pose and a height, metres.
    pub fn upright(pose: Pose, height: f64) -> Self {
        Self {
            position: Vector3::new(pose.position.x, pose.position.y, height),
            rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), pose.heading),
        }
    }

    /// Projects the pose onto the table: its position, and the direction of its x-axis as heading.
    pub fn from_above(&self) -> Pose {
        let x = self.rotation * Vector3::x();
        Pose { position: self.position.xy(), heading: x.y.atan2(x.x) }
    }

    /// Maps a point of this pose's frame into the parent frame, metres.
    pub fn point(&self, local: Vector3) -> Vector3 {
        self.position + self.rotation * local
    }

    /// Maps a point of the parent frame into this pose's frame, metres.
    pub fn local_point(&self, point: Vector3) -> Vector3 {
        self.rotation.inverse() * (point - self.position)
    }

    /// Returns the inverse pose.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { position: -(rotation * self.position), rotation }
    }

    /// Returns the pose rotated by `angle` radians about an axis, a direction through `pivot`
    /// (metres).
    pub fn turned_about(&self, pivot: Vector3, axis: Unit<Vector3>, angle: f64) -> Self {
        let turn = UnitQuaternion::from_axis_angle(&axis, angle);
        Self { position: pivot + turn * (self.position - pivot), rotation: turn * self.rotation }
    }

    /// Returns the angle between the body's vertical and the world's, radians: 0 upright, pi upside
    /// down.
    pub fn tilt(&self) -> f64 {
        (self.rotation * Vector3::z()).z.clamp(-1.0, 1.0).acos()
    }

    /// Returns the angle of the rotation to `other`, radians.
    pub fn angle_to(&self, other: &Self) -> f64 {
        self.rotation.angle_to(&other.rotation)
    }

    /// Returns `true` if all components are finite.
    pub fn is_finite(&self) -> bool {
        self.position.iter().chain(self.rotation.coords.iter()).all(|v| v.is_finite())
    }
}

impl Mul for Pose3 {
    type Output = Pose3;

    /// Composes two poses: `b` is given in the frame of `a`, and `a * b` in the parent frame of
    /// `a`.
    fn mul(self, other: Pose3) -> Pose3 {
        Pose3 { position: self.point(other.position), rotation: self.rotation * other.rotation }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn a_pose_times_its_inverse_is_the_identity() {
        let pose = Pose3::upright(Pose::new(0.3, -0.2, 2.1), 0.1).turned_about(
            Vector3::new(0.1, 0.0, 0.0),
            Vector3::y_axis(),
            0.7,
        );
        let identity = pose * pose.inverse();
        assert!(identity.position.norm() < 1e-15 && identity.tilt() < 1e-7);
    }

    #[test]
    fn a_quarter_turn_about_an_edge_stands_a_body_upright_on_it() {
        let pose = Pose3::upright(Pose::new(0.1, 0.0, 0.0), 0.0).turned_about(
            Vector3::zeros(),
            Vector3::y_axis(),
            -FRAC_PI_2,
        );
        assert!((pose.position - Vector3::new(0.0, 0.0, 0.1)).norm() < 1e-15);
        assert!((pose.tilt() - FRAC_PI_2).abs() < 1e-12);
    }
}
