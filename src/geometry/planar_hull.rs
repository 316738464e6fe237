//! The convex polygon around points of a plane.

use super::{Vector, cross};

/// Returns the convex hull of `points`, counter-clockwise (Andrew 1979, "Another efficient
/// algorithm for convex hulls in two dimensions").
///
/// Drops corners that stand out of the line between their neighbours by at most `straight`, metres.
/// Along a fine curve dropped corners add up; zero keeps all of them.
pub fn planar_hull(points: &[Vector], straight: f64) -> Vec<Vector> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut corners: Vec<Vector> = Vec::new();
    let half = |points: &mut dyn Iterator<Item = &Vector>, corners: &mut Vec<Vector>| {
        let first = corners.len();
        for point in points {
            while let [.., a, b] = corners[first..] {
                let (side, next) = (b - a, point - a);
                // Height of the middle point above the line between the others.
                if cross(side, next) > straight * next.norm() {
                    break;
                }
                corners.pop();
            }
            corners.push(*point);
        }
        // The last point begins the other half.
        corners.pop();
    };
    half(&mut sorted.iter(), &mut corners);
    half(&mut sorted.iter().rev(), &mut corners);
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_inside_and_on_sides_are_no_corners() {
        let grid = (0..25).map(|k| Vector::new(f64::from(k % 5), f64::from(k / 5)) * 0.01);
        let hull = |points: &[Vector]| planar_hull(points, 1e-6);
        let corners = hull(&grid.collect::<Vec<_>>());
        assert_eq!(corners, [[0.0, 0.0], [0.04, 0.0], [0.04, 0.04], [0.0, 0.04]].map(Vector::from));
        assert!(hull(&[Vector::zeros(); 3]).len() < 3);
        // On a fine curve every corner is kept, though none stands out by much.
        let fine = |k: u32| f64::from(k) * std::f64::consts::TAU / 40_000.0;
        let ring: Vec<Vector> =
            (0..40_000).map(|k| 0.1 * Vector::new(fine(k).cos(), fine(k).sin())).collect();
        assert!(planar_hull(&ring, 0.0).len() > 30_000);
        let line: Vec<Vector> = (0..4).map(|k| Vector::new(f64::from(k), f64::from(k))).collect();
        assert!(hull(&line).len() < 3);
    }
}
