//! Penetrating shapes: the face along which they must separate.
//!
//! A corner that has sunk in may be nearest to a side that it never crossed: if two boxes of one
//! width are pressed together, each corner lies beside a flank of the other. Such a corner alone
//! shows hardly any overlap and would let the boxes pass through each other. The face with the
//! least overlap along its normal decides (Gottschalk, Lin, Manocha 1996,
//! doi:10.1145/237170.237244).

use super::{MAX_CORNERS, Vector, cross};

/// Sine below which two faces count as parallel, so that both lead.
const PARALLEL: f64 = 1e-3;

/// Overlap of two shapes, in the frame of the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sunk {
    /// Unit normal, from the second into the first.
    pub normal: Vector,
    /// Ends of the stretch common to both faces, deepest first: the point on the first, the point
    /// on the second, metres, and the gap, which is negative.
    pub ends: [(Vector, Vector, f64); 2],
    /// Whether the leading face belongs to the first shape, and whether the facing one is parallel
    /// to it.
    pub by_first: bool,
    pub parallel: bool,
}

/// Corners of a convex shape, counter-clockwise.
#[derive(Clone, Copy)]
pub(super) struct Outline {
    corners: [Vector; MAX_CORNERS],
    count: usize,
}

impl Outline {
    pub fn of(corners: impl Iterator<Item = Vector>) -> Self {
        let mut own = Self { corners: [Vector::zeros(); MAX_CORNERS], count: 0 };
        for (place, corner) in own.corners.iter_mut().zip(corners) {
            *place = corner;
            own.count += 1;
        }
        own
    }

    fn corners(&self) -> &[Vector] {
        &self.corners[..self.count]
    }

    fn sides(&self) -> impl Iterator<Item = Side> {
        let corners = self.corners();
        (0..self.count).map(|k| Side::new(corners[k], corners[(k + 1) % corners.len()]))
    }

    /// Returns the minimum signed distance of the corners from `side`, positive outside, metres.
    fn beyond(&self, side: &Side) -> f64 {
        let out = |corner: &Vector| side.out.dot(&(corner - side.from));
        self.corners().iter().map(out).fold(f64::INFINITY, f64::min)
    }
}

/// A straight side.
#[derive(Clone, Copy)]
struct Side {
    from: Vector,
    /// Unit vector towards the other end.
    along: Vector,
    length: f64,
    /// Unit outward normal.
    out: Vector,
}

impl Side {
    fn new(from: Vector, to: Vector) -> Self {
        let length = (to - from).norm();
        let along = (to - from) / length;
        Self { from, along, length, out: Vector::new(along.y, -along.x) }
    }
}

/// Returns the overlap of two shapes; `None` if they are apart.
pub(super) fn sunk(first: &Outline, second: &Outline) -> Option<Sunk> {
    let mut best: Option<(f64, Side, bool)> = None;
    for (own, other, by_first) in [(first, second, true), (second, first, false)] {
        for side in own.sides() {
            let beyond = other.beyond(&side);
            if beyond >= 0.0 {
                return None;
            }
            if best.is_none_or(|(most, ..)| beyond > most) {
                best = Some((beyond, side, by_first));
            }
        }
    }
    let (_, side, by_first) = best?;
    let other = if by_first { second } else { first };
    // The opposing side of the other shape.
    let facing = |one: &Side| one.out.dot(&side.out);
    let faced = other.sides().min_by(|a, b| facing(a).total_cmp(&facing(b)))?;
    let place = |point: Vector| side.along.dot(&(point - side.from));
    let (a, b) = (faced.from, faced.from + faced.length * faced.along);
    let (low, high) = (place(a).min(place(b)), place(a).max(place(b)));
    let (low, high) = (low.max(0.0), high.min(side.length));
    let at = |along: f64| {
        let span = place(b) - place(a);
        let share = if span.abs() < 1e-12 { 0.5 } else { (along - place(a)) / span };
        let theirs = a + share.clamp(0.0, 1.0) * (b - a);
        let gap = side.out.dot(&(theirs - side.from));
        let ours = theirs - gap * side.out;
        if by_first { (ours, theirs, gap) } else { (theirs, ours, gap) }
    };
    let mut ends = [at(low), at(high)];
    if ends[1].2 < ends[0].2 {
        ends.swap(0, 1);
    }
    let parallel = cross(side.along, faced.along).abs() < PARALLEL;
    let normal = if by_first { -side.out } else { side.out };
    Some(Sunk { normal, ends, by_first, parallel })
}
