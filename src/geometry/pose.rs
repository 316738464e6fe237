//! Planar poses and the few vector operations that nalgebra lacks in two dimensions.

use std::ops::Mul;

use serde::{Deserialize, Serialize};

use super::{Turn, Vector};

/// A planar rigid pose: rotation by `heading`, then translation by `position`.
///
/// The heading is not wrapped, so that full rotations can be counted; compare headings with
/// [`wrap_angle`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Position of the body's centre, metres.
    pub position: Vector,
    /// Rotation about the vertical, radians, counter-clockwise.
    pub heading: f64,
}

impl Pose {
    /// Creates the pose at (`x`, `y`) metres with `heading` radians.
    #[inline]
    pub fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { position: Vector::new(x, y), heading }
    }

    /// Returns the rotation by the heading.
    #[inline]
    pub fn turn(&self) -> Turn {
        Turn::by(self.heading)
    }

    /// Maps a point of this pose's frame into the parent frame, metres.
    #[inline]
    pub fn point(&self, local: Vector) -> Vector {
        self.position + self.vector(local)
    }

    /// Rotates a vector of this pose's frame into the parent frame, without translation.
    #[inline]
    pub fn vector(&self, local: Vector) -> Vector {
        self.turn().of(local)
    }

    /// Maps a point of the parent frame into this pose's frame, metres.
    #[inline]
    pub fn local_point(&self, point: Vector) -> Vector {
        self.local_vector(point - self.position)
    }

    /// Rotates a vector of the parent frame into this pose's frame, without translation.
    #[inline]
    pub fn local_vector(&self, vector: Vector) -> Vector {
        self.turn().back(vector)
    }

    /// Returns the inverse pose.
    #[inline]
    pub fn inverse(&self) -> Self {
        Self { position: -self.local_vector(self.position), heading: -self.heading }
    }

    /// Interpolates position and heading linearly: a fraction `t` of the way to `other`.
    pub fn towards(&self, other: &Self, t: f64) -> Self {
        Self {
            position: self.position + (other.position - self.position) * t,
            heading: self.heading + (other.heading - self.heading) * t,
        }
    }

    /// Returns `true` if position and heading are finite.
    pub fn is_finite(&self) -> bool {
        self.position.iter().all(|v| v.is_finite()) && self.heading.is_finite()
    }
}

impl Mul for Pose {
    type Output = Pose;

    #[allow(clippy::suspicious_arithmetic_impl)] // composing rotations adds their angles
    /// Composes two poses: `b` is given in the frame of `a`, and `a * b` in the parent frame of
    /// `a`.
    #[inline]
    fn mul(self, other: Pose) -> Pose {
        Pose { position: self.point(other.position), heading: self.heading + other.heading }
    }
}

/// Returns the vertical component of the cross product of two planar vectors.
#[inline]
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Returns `v` rotated by a quarter turn to the left.
#[inline]
pub fn perpendicular(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// Wraps an angle into (-pi, pi], radians.
pub fn wrap_angle(angle: f64) -> f64 {
    // Nearly all angles are wrapped already, and a remainder costs as much as a sine.
    if angle > -std::f64::consts::PI && angle <= std::f64::consts::PI {
        return angle;
    }
    let wrapped = angle.rem_euclid(std::f64::consts::TAU);
    if wrapped > std::f64::consts::PI { wrapped - std::f64::consts::TAU } else { wrapped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_times_its_inverse_is_the_identity() {
        let pose = Pose::new(0.3, -0.2, 2.1);
        let identity = pose * pose.inverse();
        assert!(identity.position.norm() < 1e-15 && identity.heading == 0.0);
    }

    #[test]
    fn angles_wrap_to_the_half_open_interval() {
        let pi = std::f64::consts::PI;
        assert_eq!(wrap_angle(pi), pi);
        assert_eq!(wrap_angle(-pi), pi);
        assert!((wrap_angle(7.0 * pi + 0.1) + pi - 0.1).abs() < 1e-12);
    }
}
