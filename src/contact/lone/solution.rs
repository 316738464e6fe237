//! The solution of a lone object's frame.

use nalgebra::Vector3;

use super::{super::motion::Motion, forces::MOST, lanes::Lanes, object::Inverse};

/// What became of an object.
#[derive(Clone, Copy, Debug, Default)]
pub struct LoneSolution {
    /// None where nothing holds it, so that it coasts.
    pub motion: Option<Motion>,
    /// The forces of its contacts along their normals, N, and the force and torque of each on the
    /// object.
    pub normal: [f64; MOST],
    pub pressed: [Vector3<f64>; MOST],
    pub(super) inverse: Inverse<1>,
    pub effort: Effort,
}

/// What a frame took: updates for its displacement, equations of its last set, and all updates. The
/// next frame of a push mostly takes as much.
pub type Effort = [u32; 3];

impl LoneSolution {
    /// How force and torque move the object.
    pub fn moved(&self, pressed: &Vector3<f64>) -> Vector3<f64> {
        let pressed = [pressed.x, pressed.y, pressed.z].map(|value| Lanes([value]));
        self.inverse.by(pressed).map(|Lanes([value])| value).into()
    }
}
