//! Units of the data of a page.
//!
//! Lengths are integers in hundredths of a millimetre. Angles and times are integers in
//! ten-thousandths of a radian and of a second. This is short, and finer than anything that is
//! shown.

use pushplan::geometry::{Pose, Vector};

/// Converts a length in metres to hundredths of a millimetre.
pub fn length(metres: f64) -> i64 {
    (metres * 1e5).round() as i64
}

/// Converts an angle in radians or a time in seconds to ten-thousandths.
pub fn fine(value: f64) -> i64 {
    (value * 1e4).round() as i64
}

/// Converts a position or an extent.
pub fn point(vector: Vector) -> [i64; 2] {
    [length(vector.x), length(vector.y)]
}

/// Converts a pose to position and heading.
pub fn pose(pose: &Pose) -> [i64; 3] {
    [length(pose.position.x), length(pose.position.y), fine(pose.heading)]
}
