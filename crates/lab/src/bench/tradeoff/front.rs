//! The Pareto front of cost and error.

use serde::{Deserialize, Serialize};

/// Cost and error of a level; less of either is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Cost, in any unit.
    pub cost: f64,
    /// Error, or the share of failures.
    pub error: f64,
}

/// Insignificant differences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Relative difference of costs.
    pub cost: f64,
    /// Absolute difference of errors.
    pub error: f64,
}

/// Returns `true` if `a` makes `b` needless: neither cost nor error is larger, and one of the two
/// is smaller by more than the noise.
pub fn dominates(a: Point, b: Point, noise: Noise) -> bool {
    let no_worse = a.cost <= b.cost && a.error <= b.error;
    no_worse && (a.cost < b.cost * (1.0 - noise.cost) || a.error < b.error - noise.error)
}

/// Returns for every point whether no other one dominates it. A point that is not finite is not on
/// the front.
pub fn on_front(points: &[Point], noise: Noise) -> Vec<bool> {
    let finite = |point: &Point| point.cost.is_finite() && point.error.is_finite();
    points
        .iter()
        .map(|b| finite(b) && !points.iter().any(|a| finite(a) && dominates(*a, *b, noise)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(cost: f64, error: f64) -> Point {
        Point { cost, error }
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let points =
            [point(1.0, 9.0), point(2.0, 4.0), point(3.0, 5.0), point(4.0, 4.0), point(5.0, 1.0)];
        assert_eq!(on_front(&points, Noise::default()), [true, true, false, false, true]);
        let equal = [point(1.0, 1.0), point(1.0, 1.0), point(f64::NAN, 0.0)];
        assert_eq!(on_front(&equal, Noise::default()), [true, true, false]);
    }

    #[test]
    fn differences_within_the_noise_dominate_nothing() {
        let noise = Noise { cost: 0.1, error: 0.5 };
        assert!(!dominates(point(0.95, 4.0), point(1.0, 4.2), noise));
        assert!(dominates(point(0.85, 4.0), point(1.0, 4.2), noise));
        assert!(dominates(point(0.95, 3.0), point(1.0, 4.2), noise));
        // Better in one and worse in the other, by however little.
        assert!(!dominates(point(0.1, 4.3), point(1.0, 4.2), noise));
    }
}
