//! Convex 3-D solids, and the penetration depth of two of them.

use super::{Pose3, Vector, Vector3};

/// Length of a cross product below which its directions count as parallel.
const PARALLEL: f64 = 1e-9;

/// A convex solid: a prism or a cuboid in any pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    corners: Vec<Vector3>,
    /// Unit normals of the faces, one of each opposite pair.
    normals: Vec<Vector3>,
    /// Unit directions of the edges.
    edges: Vec<Vector3>,
}

impl Solid {
    /// Creates the prism with these base corners (metres, in order) from `bottom` to `top` along z,
    /// in the given pose.
    pub fn prism(base: &[Vector], [bottom, top]: [f64; 2], pose: &Pose3) -> Self {
        let at = |corner: &Vector, z: f64| pose.point(Vector3::new(corner.x, corner.y, z));
        let corners: Vec<Vector3> =
            [bottom, top].iter().flat_map(|z| base.iter().map(|c| at(c, *z))).collect();
        let up = pose.rotation * Vector3::z();
        let (mut normals, mut edges) = (vec![up], vec![up]);
        for (k, corner) in base.iter().enumerate() {
            let along = base[(k + 1) % base.len()] - corner;
            let Some(along) = along.try_normalize(PARALLEL) else { continue };
            edges.push(pose.rotation * Vector3::new(along.x, along.y, 0.0));
            normals.push(pose.rotation * Vector3::new(along.y, -along.x, 0.0));
        }
        Self { corners, normals, edges }
    }

    /// Creates the cuboid with these full extents (metres) about its centre, in the given pose.
    pub fn cuboid([x, y, z]: [f64; 3], pose: &Pose3) -> Self {
        let (x, y, z) = (0.5 * x, 0.5 * y, 0.5 * z);
        let corner = |k: usize| {
            let sign = |bit: usize| if k & bit == 0 { -1.0 } else { 1.0 };
            pose.point(Vector3::new(sign(1) * x, sign(2) * y, sign(4) * z))
        };
        let axes: Vec<Vector3> =
            [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis).to_vec();
        Self { corners: (0..8).map(corner).collect(), normals: axes.clone(), edges: axes }
    }

    /// Returns the penetration depth of two solids, metres; negative if they are apart.
    ///
    /// Uses the separating axes of convex solids: face normals and the cross products of two edges.
    pub fn depth(&self, other: &Self) -> f64 {
        let faces = self.normals.iter().chain(&other.normals).copied();
        let crossed = self.edges.iter().flat_map(|a| other.edges.iter().map(|b| a.cross(b)));
        let crossed = crossed.filter_map(|axis| axis.try_normalize(PARALLEL));
        let overlap = |axis: Vector3| {
            let ([a, b], [c, d]) = (self.span(axis), other.span(axis));
            (b - c).min(d - a)
        };
        faces.chain(crossed).map(overlap).fold(f64::INFINITY, f64::min)
    }

    /// Returns the height of the lowest point, metres.
    pub fn lowest(&self) -> f64 {
        self.span(Vector3::z())[0]
    }

    fn span(&self, axis: Vector3) -> [f64; 2] {
        let along = self.corners.iter().map(|corner| corner.dot(&axis));
        along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }
}

/// Returns the corners of the intersection of two convex polygons; both counter-clockwise, metres.
pub fn common_area(first: &[Vector], second: &[Vector]) -> Vec<Vector> {
    sides(second).fold(first.to_vec(), |area, (from, along)| left_of(&area, from, along))
}

/// Returns the difference of two convex polygons as disjoint convex polygons; both
/// counter-clockwise, metres.
pub fn without(first: &[Vector], second: &[Vector]) -> Vec<Vec<Vector>> {
    let (mut left, mut found) = (first.to_vec(), Vec::new());
    for (from, along) in sides(second) {
        found.push(left_of(&left, from, -along));
        left = left_of(&left, from, along);
    }
    found.retain(|piece| area_of(piece) > 0.0);
    found
}

/// Returns the area of a counter-clockwise polygon, square metres.
pub fn area_of(corners: &[Vector]) -> f64 {
    // Relative to a corner, so that no digits are lost far from the origin.
    let Some(&first) = corners.first() else { return 0.0 };
    let doubled = sides(corners).map(|(from, along)| super::cross(from - first, along));
    0.5 * doubled.sum::<f64>()
}

/// Returns the corners of a polygon, each with the vector to the next.
fn sides(corners: &[Vector]) -> impl Iterator<Item = (Vector, Vector)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&from, &to)| (from, to - from))
}

/// Clips a convex polygon to the left of a line.
fn left_of(corners: &[Vector], from: Vector, along: Vector) -> Vec<Vector> {
    let inside = |p: &Vector| super::cross(along, p - from);
    let mut left = Vec::with_capacity(corners.len() + 1);
    for (k, &p) in corners.iter().enumerate() {
        let q = corners[(k + 1) % corners.len()];
        let (a, b) = (inside(&p), inside(&q));
        if a >= 0.0 {
            left.push(p);
        }
        if a * b < 0.0 {
            left.push(p + (q - p) * (a / (a - b)));
        }
    }
    left
}

#[cfg(test)]
mod tests;
