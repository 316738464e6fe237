//! Warnings about several solids of one compound object, merged into one.

use super::Warning;

impl Warning {
    /// Returns `true` if both are about one quantity of one body. Solids of a compound object are
    /// one body.
    pub(in crate::outcome) fn is_of_body_of(&self, other: &Warning) -> bool {
        match (self, other) {
            (Warning::OutsideRange { of, .. }, Warning::OutsideRange { of: other_of, .. }) => {
                of == other_of && self.is_like(other)
            }
            _ => false,
        }
    }

    /// Returns the distance of a quantity from its range, in its own unit; 0 for other warnings.
    pub(in crate::outcome) fn excess(&self) -> f64 {
        match *self {
            Warning::OutsideRange { value, low, high, .. } => (low - value).max(value - high),
            _ => 0.0,
        }
    }

    /// Returns the error expected for an object, metres, of a warning about a large one.
    pub(crate) fn doubt_of(&mut self, name: &str) -> Option<&mut f64> {
        match self {
            Warning::Doubtful { object, within } if object == name => Some(within),
            _ => None,
        }
    }
}
