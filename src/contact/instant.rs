//! The instants of a frame at which contacts and joints are evaluated, as shares of the frame.

/// Half-way, for displacements.
pub(super) const HALF: f64 = 0.5;

/// At the end, for velocities.
pub(super) const WHOLE: f64 = 1.0;
