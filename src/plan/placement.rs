//! Position at which a tool begins a push, and its distance from the pushed object.

use crate::geometry::Vector;

/// Travel of the contacting face before it meets the object, metres (by the definition of a
/// placed push).
pub const STAND_OFF: f64 = 0.005;

/// Position at which a tool begins a push.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Position of the end effector.
    pub start: Vector,
    /// Position uncertainty of the pushed object, metres.
    pub room: f64,
    /// Distance by which the tool is set down farther back, so that it clears overhanging parts of
    /// the pushed object, metres.
    pub back: f64,
}

impl Placement {
    /// Creates the placement at a position without an overhang, for an object at a known position.
    pub const fn at(start: Vector) -> Self {
        Self { start, room: 0.0, back: 0.0 }
    }

    /// Returns the travel before the tool meets the pushed object, metres.
    pub fn approach(&self) -> f64 {
        STAND_OFF + self.room + self.back
    }
}
