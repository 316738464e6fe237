//! The part of a rectangle's boundary that is the boundary of a body composed of several
//! rectangles.

use super::Vector;

/// Cosine to a face beyond which a contact normal counts as a corner's (3 degrees): flush faces
/// must count as such whatever their rounding.
const FLUSH: f64 = 0.05;

/// Distance by which a contact may lie beyond the end of a stretch, metres: bodies in an inner
/// corner sink slightly into the face that ends the stretch.
const BEYOND: f64 = 1e-3;

/// The stretches of a rectangle's sides, and the corners, that are exposed to contact.
///
/// The rectangles of one body overlap and their faces are aligned. A solver that treats each
/// rectangle alone therefore finds faces and corners that the body does not have: a box that slides
/// along the body is caught by the corner of the next rectangle. Every stretch of the body's
/// boundary belongs to one of its rectangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rim {
    /// Exposed stretches of the sides that face +x, +y, -x, -y, as ranges of the coordinate along
    /// the side in the rectangle's frame, metres.
    pub sides: [Vec<(f64, f64)>; 4],
    /// Exposed corners: (+,+), (-,+), (-,-), (+,-).
    pub corners: [bool; 4],
}

impl Rim {
    /// Returns `true` if the rectangle can be touched at `point` with the unit `normal` pointing
    /// out of it, both in its frame.
    pub fn shows(&self, point: Vector, normal: Vector) -> bool {
        let on = |side: usize, along: f64| {
            let holds = |&(low, high): &(f64, f64)| low - BEYOND <= along && along <= high + BEYOND;
            self.sides[side].iter().any(holds)
        };
        if normal.y.abs() <= FLUSH {
            on(if normal.x > 0.0 { 0 } else { 2 }, point.y)
        } else if normal.x.abs() <= FLUSH {
            on(if normal.y > 0.0 { 1 } else { 3 }, point.x)
        } else {
            self.corners[corner(point.x > 0.0, point.y > 0.0)]
        }
    }
}

/// Returns the index of the corner on these sides of the centre.
pub(super) fn corner(right: bool, upper: bool) -> usize {
    match (right, upper) {
        (true, true) => 0,
        (false, true) => 1,
        (false, false) => 2,
        (true, false) => 3,
    }
}
