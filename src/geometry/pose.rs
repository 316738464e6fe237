//! Planar poses and the few vector operations that nalgebra lacks in two dimensions.

use std::ops::Mul;

use serde::{Deserialize, Serialize};

use super::{Turn, Vector};

/// A planar rigid pose: turn by `heading`, then shift by `position`.
///
/// The heading is not wrapped, so that turns can be counted; compare headings with
/// [`wrap_angle`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Position of the body's centre, metres.
    pub position: Vector,
    /// Turn about the vertical, radians, counter-clockwise.
    pub heading: f64,
}

impl Pose {
    /// The pose at (`x`, `y`) metres with `heading` radians.
    #[inline]
    pub fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { position: Vector::new(x, y), heading }
    }

    /// The turn by its heading.
    #[inline]
    pub fn turn(&self) -> Turn {
        Turn::by(self.heading)
    }

    /// Maps a point of this pose's frame into the parent frame, metres.
    #[inline]
    pub fn point(&self, local: Vector) -> Vector {
        self.position + self.vector(local)
    }

    /// Turns a vector of this pose's frame into the parent frame, without shifting it.
    #[inline]
    pub fn vector(&self, local: Vector) -> Vector {
        self.turn().of(local)
    }

    /// Maps a point of the parent frame into this pose's frame, metres.
    #[inline]
    pub fn local_point(&self, point: Vector) -> Vector {
        self.local_vector(point - self.position)
    }

    /// Turns a vector of the parent frame into this pose's frame, without shifting it.
    #[inline]
    pub fn local_vector(&self, vector: Vector) -> Vector {
        self.turn().back(vector)
    }

    /// The pose that undoes this one.
    #[inline]
    pub fn inverse(&self) -> Self {
        Self { position: -self.local_vector(self.position), heading: -self.heading }
    }

    /// The pose a fraction `t` of the way to `other`, turning evenly.
    pub fn towards(&self, other: &Self, t: f64) -> Self {
        Self {
            position: self.position + (other.position - self.position) * t,
            heading: self.heading + (other.heading - self.heading) * t,
        }
    }

    /// Whether position and heading are finite numbers.
    pub fn is_finite(&self) -> bool {
        self.position.iter().all(|v| v.is_finite()) && self.heading.is_finite()
    }
}

impl Mul for Pose {
    type Output = Pose;

    #[allow(clippy::suspicious_arithmetic_impl)] // composing turns adds their angles
    /// `a * b`: the pose `b`, given in the frame of `a`, in the parent frame of `a`.
    #[inline]
    fn mul(self, other: Pose) -> Pose {
        Pose { position: self.point(other.position), heading: self.heading + other.heading }
    }
}

/// The vertical component of the cross product of two planar vectors.
#[inline]
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// `v` turned left by a quarter turn.
#[inline]
pub fn perpendicular(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// The same angle in (-pi, pi], radians.
pub fn wrap_angle(angle: f64) -> f64 {
    // Nearly all are, and a remainder takes as long as a sine.
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
