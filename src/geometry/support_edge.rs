//! The edge that a levered plate tips over.

use super::Vector;

/// A side of a convex outline, as seen from a point of the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportEdge {
    /// The side from this corner to the next.
    pub edge: usize,
    /// Distance of the line through it from the point, metres: the radius on which the point
    /// turns while the body tips over this side.
    pub distance: f64,
    /// Where the ray goes through the side, from 0 at its first corner to 1 at the next. Near
    /// either end the neighbour is almost as likely.
    pub fraction: f64,
}

/// The side of a convex outline by which the ray from `point` through `centre` leaves it: a body
/// whose edge is raised at `point` stands on the two corners between which its weight then lies.
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
        // Points out of a counter-clockwise outline.
        let normal = Vector::new(along.y, -along.x) / length;
        let (approach, distance) = (normal.dot(&ray), normal.dot(&(a - point)));
        let leaves = approach > 0.0 && length > 0.0;
        let at = distance / approach;
        // Of the sides that look along the ray the first one that it meets.
        if leaves && at.is_finite() && found.is_none_or(|(best, _)| at < best) {
            let fraction = along.dot(&(point + ray * at - a)) / (length * length);
            found = Some((at, SupportEdge { edge, distance, fraction }));
        }
    }
    found.map(|(_, edge)| edge)
}

#[cfg(test)]
mod tests;
