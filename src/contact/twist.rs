//! Twists of rigid groups: displacement of the centre and rotation in one vector (x, y, angle).

use nalgebra::Vector3;

use crate::geometry::{Vector, cross, perpendicular};

/// Returns the row of the displacement along `direction` of a point `arm` metres from a group's
/// centre.
#[inline]
pub(super) fn along(direction: Vector, arm: Vector) -> Vector3<f64> {
    Vector3::new(direction.x, direction.y, cross(arm, direction))
}

/// Returns the displacement of a point `arm` metres from a group's centre, to first order, metres.
#[inline]
pub(super) fn shift(twist: &Vector3<f64>, arm: Vector) -> Vector {
    Vector::new(twist.x, twist.y) + twist.z * perpendicular(arm)
}
