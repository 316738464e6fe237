//! Quantities in words.

use crate::decimals::fixed;
use crate::geometry::Vector;

/// Formats a length given in metres.
pub(super) fn millimetres(metres: f64) -> String {
    let value = metres * 1e3;
    if !value.is_finite() {
        "not finite".to_owned()
    } else if value.abs() < 99.95 {
        format!("{} mm", fixed(value, 1))
    } else {
        format!("{value:.0} mm")
    }
}

/// Formats an angle given in radians.
pub(super) fn degrees(radians: f64) -> String {
    let value = radians.to_degrees();
    if value.is_finite() { format!("{}\u{00b0}", fixed(value, 1)) } else { "not finite".to_owned() }
}

/// Formats a position on the table, metres.
pub(super) fn point(position: Vector) -> String {
    format!("({}, {}) m", fixed(position.x, 3), fixed(position.y, 3))
}
