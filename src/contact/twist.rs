//! Twists of rigid groups: shift of the centre and turn, as one vector (x, y, turn).

use nalgebra::Vector3;

use crate::geometry::{Vector, cross, perpendicular};

/// The row of the displacement along `direction` of a point `arm` metres from a group's centre.
#[inline]
pub(super) fn along(direction: Vector, arm: Vector) -> Vector3<f64> {
    Vector3::new(direction.x, direction.y, cross(arm, direction))
}

/// Displacement of a point `arm` metres from a group's centre, to first order, metres.
#[inline]
pub(super) fn shift(twist: &Vector3<f64>, arm: Vector) -> Vector {
    Vector::new(twist.x, twist.y) + twist.z * perpendicular(arm)
}
