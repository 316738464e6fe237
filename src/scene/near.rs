//! Pairs of objects near enough to be joined.

use crate::geometry::{Vector, contact_points};

use super::Scene;

/// Largest gap at the start of objects that may be joined, metres.
pub const JOINABLE: f64 = 0.03;

/// Returns the pairs of objects that may be joined, lower index first, with the midpoint of their
/// closest points.
pub fn near_pairs(scene: &Scene) -> Vec<([usize; 2], Vector)> {
    let pairs = pairs_within(scene, JOINABLE).into_iter();
    pairs.map(|pair| (pair.between, pair.midway)).collect()
}

/// Two objects near each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearPair {
    /// Indices of the objects, the lower first.
    pub between: [usize; 2],
    /// Distance of the closest points, metres; negative if the objects overlap.
    pub gap: f64,
    /// Midpoint of the closest points.
    pub midway: Vector,
}

/// Returns the pairs of objects with a gap of at most `reach` metres.
pub fn pairs_within(scene: &Scene, reach: f64) -> Vec<NearPair> {
    let objects = &scene.objects;
    let mut pairs = Vec::new();
    for (a, first) in objects.iter().enumerate() {
        for (b, second) in objects.iter().enumerate().skip(a + 1) {
            let (one, other) = (first.shape.footprint(), second.shape.footprint());
            let (points, _) = contact_points((&one, &first.pose), (&other, &second.pose), reach);
            if let Some(point) = points[0] {
                let midway = (point.on_first + point.on_second) / 2.0;
                pairs.push(NearPair { between: [a, b], gap: point.gap, midway });
            }
        }
    }
    pairs
}
