//! A closed interval.

use serde::{Deserialize, Serialize};

/// Values within this relative distance of a bound still count as inside: the speed of a recorded
/// push is known no better, and no model changes within one per cent.
const SLACK: f64 = 1e-2;

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
}

impl Span {
    /// The empty interval; its ends are finite, so that it can be written down.
    pub const NOTHING: Self = Self { low: f64::MAX, high: f64::MIN };

    /// The interval from `low` to `high`.
    pub const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// How much there is between its ends.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// The smallest interval that contains both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether `value` lies inside, up to rounding.
    pub fn contains(&self, value: f64) -> bool {
        value >= self.low * (1.0 - SLACK) && value <= self.high * (1.0 + SLACK)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_reached_by_division_or_measured_counts_as_inside() {
        let speed = Span::new(0.03, 0.3);
        assert!(speed.contains(0.2 / (0.2 / 0.3)) && speed.contains(0.1 / (0.1 / 0.03)));
        assert!(speed.contains(f64::from(0.03f32)) && speed.contains(0.029_98));
        assert!(!speed.contains(0.31) && !speed.contains(f64::NAN));
    }
}
