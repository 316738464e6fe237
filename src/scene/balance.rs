//! The share of a weight that each of several points carries.

use crate::geometry::Vector;

/// Returns the shares of the weight that the points carry if its centre of mass is at the origin.
/// The chosen shares are the nearest to equal ones, as under equal springs. Returns `None` if the
/// origin is outside of the convex hull of the points.
pub fn carries(points: &[Vector]) -> Option<Vec<f64>> {
    balanced(points, &vec![1.0; points.len()])
}

/// Computes [`carries`] for points whose shares would be these `weights` if the origin were their
/// weighted mean.
pub(super) fn balanced(points: &[Vector], weights: &[f64]) -> Option<Vec<f64>> {
    let mut used = vec![true; points.len()];
    loop {
        if !used.contains(&true) {
            return None;
        }
        // Loads w (a + b . point) of sum one and without moment: three equations, by Cramer's rule.
        let among = || (0..points.len()).filter(|&k| used[k]).map(|k| (points[k], weights[k]));
        let n: f64 = among().map(|(_, weight)| weight).sum();
        let sum: Vector = among().map(|(point, weight)| weight * point).sum();
        let xx: f64 = among().map(|(point, weight)| weight * point.x * point.x).sum();
        let xy: f64 = among().map(|(point, weight)| weight * point.x * point.y).sum();
        let yy: f64 = among().map(|(point, weight)| weight * point.y * point.y).sum();
        let a = xx * yy - xy * xy;
        let b = Vector::new(sum.y * xy - sum.x * yy, sum.x * xy - sum.y * xx);
        let whole = n * a + sum.dot(&b);
        // Points on one line carry nothing: the body would tip.
        if whole <= 1e-9 * n * (xx + yy) * (xx + yy) {
            return None;
        }
        let load = |k: usize| weights[k] * (a + b.dot(&points[k])) / whole;
        let lowest = (0..points.len()).filter(|&k| used[k]).map(|k| (k, load(k)));
        let lowest = lowest.min_by(|a, b| a.1.total_cmp(&b.1))?;
        if lowest.1 < -1e-9 {
            used[lowest.0] = false;
            continue;
        }
        let loads: Vec<f64> =
            (0..points.len()).map(|k| if used[k] { load(k).max(0.0) } else { 0.0 }).collect();
        let moment: Vector = points.iter().zip(&loads).map(|(point, load)| *load * point).sum();
        let sum: f64 = loads.iter().sum();
        return (moment.norm() < 1e-6 && (sum - 1.0).abs() < 1e-6).then_some(loads);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_points_carry_what_lies_between_them_and_nothing_else() {
        let points = [(0.03, 0.0), (-0.02, 0.02), (-0.02, -0.04)].map(|(x, y)| Vector::new(x, y));
        let loads = carries(&points).expect("the origin is inside");
        let centre: Vector = points.iter().zip(&loads).map(|(at, load)| *load * at).sum();
        assert!(centre.norm() < 1e-12 && loads.iter().all(|load| *load > 0.0), "{loads:?}");
        let aside = points.map(|point| point + Vector::new(0.1, 0.0));
        assert_eq!(carries(&aside), None);
    }

    #[test]
    fn points_share_the_weight_as_equally_as_they_can() {
        let square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let square = square.map(|(x, y)| Vector::new(x, y));
        let loads = carries(&square).expect("inside");
        assert!(loads.iter().all(|load| (load - 0.25).abs() < 1e-12));
        // A fifth point far out on one side carries less.
        let lopsided = [&square[..], &[Vector::new(8.0, 0.0)]].concat();
        let loads = carries(&lopsided).expect("inside");
        assert!(loads[4] < loads[0] && loads[0] < loads[1], "{loads:?}");
    }
}
