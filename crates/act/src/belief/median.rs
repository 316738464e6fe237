//! Medians of weighted points.

use pushplan::geometry::Vector;

/// Number of iterations; the error is then below 0.001 of the extent of the points.
const STEPS: usize = 64;

/// Returns the point with the minimum weighted sum of distances to `points`.
///
/// Computed with Weiszfeld's iteration, and with the test of Vardi and Zhang
/// (doi:10.1073/pnas.97.4.1423) if the minimum is one of the points.
///
/// # Panics
///
/// Panics if `points` is empty.
pub(super) fn geometric_median(points: &[(f64, Vector)]) -> Vector {
    let cost = |at: Vector| points.iter().map(|(weight, p)| weight * (p - at).norm()).sum::<f64>();
    let nearest = points.iter().map(|(_, point)| (cost(*point), *point));
    let (_, best) = nearest.min_by(|a, b| a.0.total_cmp(&b.0)).expect("some points");
    let (here, away): (Vec<_>, Vec<_>) = points.iter().partition(|(_, point)| *point == best);
    let held: f64 = here.iter().map(|(weight, _)| weight).sum();
    let pull: Vector = away.iter().map(|(weight, p)| *weight * (p - best).normalize()).sum();
    if pull.norm() <= held {
        return best;
    }
    let all: f64 = points.iter().map(|(weight, _)| weight).sum();
    let mut at = points.iter().map(|(weight, p)| *weight * p).sum::<Vector>() / all;
    for _ in 0..STEPS {
        let near = |(weight, p): &(f64, Vector)| (weight / (p - at).norm().max(1e-9), *p);
        let (sum, of) = points
            .iter()
            .map(near)
            .fold((Vector::zeros(), 0.0), |(sum, of): (Vector, f64), (weight, p)| {
                (sum + weight * p, of + weight)
            });
        at = sum / of;
    }
    at
}

/// Returns the weighted median.
///
/// # Panics
///
/// Panics if `numbers` is empty.
pub(super) fn weighted_median(mut numbers: Vec<(f64, f64)>) -> f64 {
    numbers.sort_by(|a, b| a.1.total_cmp(&b.1));
    let half = 0.5 * numbers.iter().map(|(weight, _)| weight).sum::<f64>();
    let mut below = 0.0;
    let found = numbers.iter().find(|(weight, _)| {
        below += weight;
        below >= half
    });
    found.or(numbers.last()).expect("some numbers").1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_of_a_triangle_sees_its_sides_under_equal_angles() {
        let points = [[0.0, 0.0], [1.0, 0.0], [0.3, 0.8]].map(|[x, y]| (1.0, Vector::new(x, y)));
        let at = geometric_median(&points);
        let [a, b, c] = points.map(|(_, point)| (point - at).normalize());
        for between in [a.dot(&b), b.dot(&c), c.dot(&a)] {
            assert!((between + 0.5).abs() < 1e-3, "{between}");
        }
    }

    #[test]
    fn a_point_with_half_of_the_weight_is_the_median() {
        let points = [(2.0, [0.0, 0.0]), (1.0, [1.0, 0.0]), (1.0, [0.0, 3.0])];
        let points = points.map(|(weight, [x, y])| (weight, Vector::new(x, y)));
        assert_eq!(geometric_median(&points), Vector::zeros());
        // Triangle with an angle of more than 120 degrees.
        let flat = [[-1.0, 0.2], [0.0, 0.0], [1.0, 0.2]].map(|[x, y]| (1.0, Vector::new(x, y)));
        assert_eq!(geometric_median(&flat), Vector::zeros());
        assert_eq!(geometric_median(&[(1.0, Vector::new(0.4, 0.1)); 3]), Vector::new(0.4, 0.1));
        assert_eq!(weighted_median(vec![(1.0, 5.0), (4.0, 7.0), (2.0, 9.0)]), 7.0);
    }
}
