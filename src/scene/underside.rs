//! Even pressure under a prism, represented by few points.

use crate::geometry::{ConvexPolygon, Vector, cross};

/// Returns points and shares of the weight that represent even pressure under a polygon. Two or
/// four points lie in each triangle between a side and the centre of mass, with loads that have the
/// second moments of the triangle.
///
/// Three or four corners: points at two places along a side and at two depths, which also makes the
/// torque of rotations on the spot exact. More corners: points at the midpoints of the triangle's
/// sides, shared with the neighbours; that torque is then 1 to 4 % too large.
pub(super) fn underside(polygon: &ConvexPolygon) -> (Vec<Vector>, Vec<f64>) {
    let whole = 2.0 * polygon.area();
    let sides = || polygon.sides().map(|(a, b)| (a, b, cross(a, b) / whole));
    let (mut points, mut loads) = (Vec::new(), Vec::new());
    if polygon.corners().len() <= 4 {
        // Gauss-Legendre points along the side.
        let places: Vec<(Vector, f64)> = sides()
            .flat_map(|(a, b, share)| {
                let (middle, off) = ((a + b) / 2.0, (b - a) / 12f64.sqrt());
                [(middle - off, share / 2.0), (middle + off, share / 2.0)]
            })
            .collect();
        // Depths with mean square 1/2 and the mean that gives the mean radius.
        let outside: f64 = places.iter().map(|(place, load)| load * place.norm()).sum();
        let mean = polygon.mean_radius() / outside;
        let off = (0.5 - mean * mean).max(0.0).sqrt();
        for depth in [mean - off, mean + off] {
            points.extend(places.iter().map(|(place, _)| depth * place));
            loads.extend(places.iter().map(|(_, load)| load / 2.0));
        }
    } else {
        let mut before = sides().last().map_or(0.0, |(_, _, share)| share);
        for (a, b, share) in sides() {
            points.extend([a / 2.0, (a + b) / 2.0]);
            loads.extend([(before + share) / 3.0, share / 3.0]);
            before = share;
        }
    }
    (points, loads)
}

#[cfg(test)]
mod tests;
