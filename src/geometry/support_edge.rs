//! The edge over which a levered plate tips.

use super::Vector;

/// A side of a convex outline, relative to a point of the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportEdge {
    /// Index of the side's first corner; the side runs to the next corner.
    pub edge: usize,
    /// Distance of the side's line from the point, metres: the radius of the point's rotation while
    /// the body tips over this side.
    pub distance: f64,
    /// Position of the ray's exit on the side, from 0 at its first corner to 1 at the next. Near
    /// either end the neighbouring side is almost as likely.
    pub fraction: f64,
}

/// Returns the side of a convex outline at which the ray from `point` through `centre` leaves it. A
/// body whose edge is raised at `point` stands on the two corners of that side, because its weight
/// then lies between them.
///
/// `corners` run counter-clockwise, metres; `point` lies on the outline. `None` if the outline has
/// no area or `point` is `centre`.
pub fn support_edge(corners: &[Vector], point: Vector, centre: Vector) -> Option<SupportEdge> {
    let ray = centre - point;
    let mut found: Option<(f64, SupportEdge)> = None;
    for (edge, a) in corners.iter().enumerate() {
        let b = corners[(edge + 1) % corners.len()];
        let along = b - a;
        let length = along.norm();
        // Outward normal of a counter-clockwise outline.
        let normal = Vector::new(along.y, -along.x) / length;
        let (approach, distance) = (normal.dot(&ray), normal.dot(&(a - point)));
        let leaves = approach > 0.0 && length > 0.0;
        let at = distance / approach;
        // The first side that the ray leaves through.
        if leaves && at.is_finite() && found.is_none_or(|(best, _)| at < best) {
            let fraction = along.dot(&(point + ray * at - a)) / (length * length);
            found = Some((at, SupportEdge { edge, distance, fraction }));
        }
    }
    found.map(|(_, edge)| edge)
}

#[cfg(test)]
mod tests;
