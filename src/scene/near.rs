//! Objects so near each other that they may be joined.

use crate::geometry::{Vector, contact_points};

use super::Scene;

/// Objects with a larger gap at the start are taken not to be joined, metres.
pub const JOINABLE: f64 = 0.03;

/// Pairs of objects that may be joined, lower index first, and the point midway between the closest
/// points of each.
pub fn near_pairs(scene: &Scene) -> Vec<([usize; 2], Vector)> {
    let objects = &scene.objects;
    let mut pairs = Vec::new();
    for (a, first) in objects.iter().enumerate() {
        for (b, second) in objects.iter().enumerate().skip(a + 1) {
            let (one, other) = (first.shape.footprint(), second.shape.footprint());
            let (points, _) = contact_points((&one, &first.pose), (&other, &second.pose), JOINABLE);
            if let Some(point) = points[0] {
                pairs.push(([a, b], (point.on_first + point.on_second) / 2.0));
            }
        }
    }
    pairs
}
