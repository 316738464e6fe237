//! A closed interval.

use serde::{Deserialize, Serialize};

/// Relative distance from a bound within which values count as inside. The speed of a recorded push
/// has no smaller error, and no model changes within one per cent.
const SLACK: f64 = 1e-2;

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Span {
    /// The empty interval; its ends are finite, so that it can be serialised.
    pub const NOTHING: Self = Self { low: f64::MAX, high: f64::MIN };

    /// Creates the interval from `low` to `high`.
    pub const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// Returns the difference of its ends.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// Returns the smallest interval that contains both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Returns `true` if `value` is inside, up to a tolerance of one per cent.
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
