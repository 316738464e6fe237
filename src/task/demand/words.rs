//! Quantities in words.

use crate::geometry::Vector;

/// Formats a length given in metres.
pub(super) fn millimetres(metres: f64) -> String {
    let value = metres * 1e3;
    if !value.is_finite() {
        "not finite".to_owned()
    } else if value.abs() < 99.95 {
        format!("{value:.1} mm")
    } else {
        format!("{value:.0} mm")
    }
}

/// Formats an angle given in radians.
pub(super) fn degrees(radians: f64) -> String {
    let value = radians.to_degrees();
    if value.is_finite() { format!("{value:.1}\u{00b0}") } else { "not finite".to_owned() }
}

/// Formats a position on the table, metres.
pub(super) fn point(position: Vector) -> String {
    format!("({:.3}, {:.3}) m", position.x + 0.0, position.y + 0.0)
}
