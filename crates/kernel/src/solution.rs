//! The solution of a frame of one object.

use nalgebra::Vector3;

use crate::{forces::MOST, lanes::Lanes, motion::Motion, object::Inverse};

/// Motion of the object and forces on it.
#[derive(Clone, Copy, Debug, Default)]
pub struct SingleBodySolution {
    /// Motion of the object; `None` if it has no active contact and coasts.
    pub motion: Option<Motion>,
    /// Forces of its contacts along their normals, N.
    pub normal: [f64; MOST],
    /// Force and torque of each contact on the object, N and N m.
    pub pressed: [Vector3<f64>; MOST],
    pub(crate) inverse: Inverse<1>,
    /// Work spent on the solution.
    pub effort: Effort,
}

/// Number of updates for the displacement, of equations in the last set, and of all updates. The
/// next frame of a push usually takes as much work.
pub type Effort = [u32; 3];

impl SingleBodySolution {
    /// Returns the shift and rotation of the object due to a force and torque.
    pub fn moved(&self, pressed: &Vector3<f64>) -> Vector3<f64> {
        let pressed = [pressed.x, pressed.y, pressed.z].map(|value| Lanes([value]));
        self.inverse.by(pressed).map(|Lanes([value])| value).into()
    }

    /// Returns the displacement per force and torque, a symmetric matrix: xx, xy, xz, yy, yz and
    /// zz.
    pub fn inverse(&self) -> [f64; 6] {
        self.inverse.0.map(|Lanes([value])| value)
    }
}
