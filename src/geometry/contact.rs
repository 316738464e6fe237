//! Contact points of two footprints that touch or are close.
//!
//! Two flat faces meet in a line whose ends carry the contact. Up to two points are therefore
//! returned, as in the contact manifold of a physics engine. Parry is not used because the graph
//! also needs both points at a distance, and the same numbers in either argument order, for many
//! pairs in every step of every rollout.

use pushplan_kernel::Follows;

use super::flat::{Faced, Flat, Rectangle};
use super::sunk::{Outline, Sunk, sunk};
use super::{Footprint, MAX_CORNERS, Pose, Turn, Vector};

/// Distance below which two points of one pair are one contact, metres.
const SAME_POINT: f64 = 1e-3;

/// Maximum distance between two computations of one point, metres.
const ROUNDING: f64 = 1e-9;

/// Excess of penetration over the corner gaps beyond which shapes have passed through a face that
/// is nearest to no corner, metres. Also the corner gap below which this is checked.
const THROUGH: f64 = 1e-4;

/// A point where two bodies are close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// The point on the first body, world frame, metres.
    pub on_first: Vector,
    /// The point on the second body, world frame, metres.
    pub on_second: Vector,
    /// Unit normal, pointing from the second body into the first.
    pub normal: Vector,
    /// Distance along the normal, metres; negative where the bodies overlap.
    pub gap: f64,
    /// The body or bodies with which the normal rotates.
    pub follows: Follows,
}

impl ContactPoint {
    /// Returns this contact with both bodies exchanged.
    pub fn flipped(self) -> Self {
        Self {
            on_first: self.on_second,
            on_second: self.on_first,
            normal: -self.normal,
            gap: self.gap,
            follows: match self.follows {
                Follows::First => Follows::Second,
                Follows::Second => Follows::First,
                Follows::Between(first, second) => Follows::Between(second, first),
                other => other,
            },
        }
    }
}

/// A footprint at a pose with the heading's rotation, so that sines are computed only once.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    footprint: &'a Footprint,
    pose: Pose,
    turn: Turn,
}

impl<'a> Placed<'a> {
    /// Places the footprint at a pose.
    pub fn new(footprint: &'a Footprint, pose: Pose) -> Self {
        Self::turned(footprint, pose, pose.turn())
    }

    /// Places the footprint at a pose whose rotation is already known.
    pub fn turned(footprint: &'a Footprint, pose: Pose, turn: Turn) -> Self {
        Self { footprint, pose, turn }
    }

    /// Returns the position of the centre, metres.
    pub fn position(&self) -> Vector {
        self.pose.position
    }

    /// Maps a point of the world into the footprint's frame, metres.
    pub fn local_point(&self, point: Vector) -> Vector {
        self.turn.back(point - self.pose.position)
    }

    /// Rotates a vector of the world into the footprint's frame.
    pub fn local_vector(&self, vector: Vector) -> Vector {
        self.turn.back(vector)
    }
}

/// Returns `true` if two footprints are certainly farther apart than `reach` metres.
pub fn far_apart(first: &Placed, second: &Placed, reach: f64) -> bool {
    let [p, q] = [first, second].map(|placed| placed.footprint.bounding_radius());
    (first.position() - second.position()).norm() > p + q + reach
}

/// Returns the one or two contact points of two posed footprints whose gap is at most `reach`
/// metres, closest first; none if the bodies are farther apart.
///
/// Only two shapes with corners give two points: the closest pair of a corner of one and the
/// boundary of the other, and the next such pair at another place.
pub fn contact_points(
    first: (&Footprint, &Pose),
    second: (&Footprint, &Pose),
    reach: f64,
) -> ([Option<ContactPoint>; 2], usize) {
    let [first, second] = [first, second].map(|(footprint, pose)| Placed::new(footprint, *pose));
    match far_apart(&first, &second, reach) {
        true => ([None, None], 0),
        false => contact_points_of(&first, &second, reach),
    }
}

/// Returns the [`contact_points`] of two footprints that are not [`far_apart`].
pub fn contact_points_of(
    at: &Placed,
    bt: &Placed,
    reach: f64,
) -> ([Option<ContactPoint>; 2], usize) {
    match (at.footprint, bt.footprint) {
        (&Footprint::Disc { radius: a }, &Footprint::Disc { radius: b }) => {
            single(disc_disc(at.position(), a, bt.position(), b), reach)
        }
        (&Footprint::Disc { radius }, &Footprint::Rectangle { half }) => {
            single(disc_flat(at.position(), radius, bt, &Rectangle(half)), reach)
        }
        (&Footprint::Disc { radius }, Footprint::Polygon(polygon)) => {
            single(disc_flat(at.position(), radius, bt, &Faced::new(polygon)), reach)
        }
        (&Footprint::Rectangle { half }, &Footprint::Disc { radius }) => {
            single(disc_flat(bt.position(), radius, at, &Rectangle(half)).flipped(), reach)
        }
        (Footprint::Polygon(polygon), &Footprint::Disc { radius }) => {
            single(disc_flat(bt.position(), radius, at, &Faced::new(polygon)).flipped(), reach)
        }
        (&Footprint::Rectangle { half: a }, &Footprint::Rectangle { half: b }) => {
            flats((at, &Rectangle(a)), (bt, &Rectangle(b)), reach, &mut [Candidate::NONE; 8])
        }
        (&Footprint::Rectangle { half }, Footprint::Polygon(b)) => {
            flats((at, &Rectangle(half)), (bt, &Faced::new(b)), reach, &mut [Candidate::NONE; MANY])
        }
        (Footprint::Polygon(a), &Footprint::Rectangle { half }) => {
            flats((at, &Faced::new(a)), (bt, &Rectangle(half)), reach, &mut [Candidate::NONE; MANY])
        }
        (Footprint::Polygon(a), Footprint::Polygon(b)) => {
            flats((at, &Faced::new(a)), (bt, &Faced::new(b)), reach, &mut [Candidate::NONE; MANY])
        }
    }
}

fn single(point: ContactPoint, reach: f64) -> ([Option<ContactPoint>; 2], usize) {
    if point.gap <= reach { ([Some(point), None], 1) } else { ([None, None], 0) }
}

fn disc_disc(a: Vector, radius_a: f64, b: Vector, radius_b: f64) -> ContactPoint {
    let between = a - b;
    let distance = between.norm();
    // Concentric discs have no normal; an arbitrary one is used.
    let normal = if distance > 1e-12 { between / distance } else { Vector::x() };
    ContactPoint {
        on_first: a - normal * radius_a,
        on_second: b + normal * radius_b,
        normal,
        gap: distance - radius_a - radius_b,
        follows: Follows::Between(a, b),
    }
}

fn disc_flat(
    centre: Vector,
    radius: f64,
    Placed { pose, turn, .. }: &Placed,
    shape: &impl Flat,
) -> ContactPoint {
    let nearest = shape.nearest(turn.back(centre - pose.position));
    let on_second = pose.position + turn.of(nearest.point);
    let follows =
        if nearest.on_face { Follows::Second } else { Follows::Between(centre, on_second) };
    let normal = turn.of(nearest.normal);
    ContactPoint {
        on_first: centre - normal * radius,
        on_second,
        normal,
        gap: nearest.distance - radius,
        follows,
    }
}

/// Maximum number of corners of two polygons.
const MANY: usize = 2 * MAX_CORNERS;

/// A corner of one shape and the boundary of the other, in the frame of the first.
#[derive(Clone, Copy)]
struct Candidate {
    on_first: Vector,
    on_second: Vector,
    /// Unit normal, from the second into the first.
    normal: Vector,
    gap: f64,
    follows: Follows,
}

impl Candidate {
    const NONE: Self = {
        let zero = Vector::new(0.0, 0.0);
        let (on_first, on_second, normal) = (zero, zero, zero);
        Self { on_first, on_second, normal, gap: f64::INFINITY, follows: Follows::Nothing }
    };

    fn is_at(&self, other: &Self, distance: f64) -> bool {
        (self.on_first - other.on_first).norm() < distance
            && (self.on_second - other.on_second).norm() < distance
    }
}

/// Finds the contact points of two shapes with corners. `room` has one candidate for each corner of
/// both.
fn flats<A: Flat, B: Flat>(
    (Placed { pose: a, turn, .. }, first): (&Placed, &A),
    (Placed { pose: b, turn: other, .. }, second): (&Placed, &B),
    reach: f64,
    room: &mut [Candidate],
) -> ([Option<ContactPoint>; 2], usize) {
    let (b_from_a, b_turn) = (turn.back(b.position - a.position), other.from(turn));
    let to_a = |p: Vector| b_from_a + b_turn.of(p);
    let to_b = |p: Vector| b_turn.back(p - b_from_a);

    let of_first = first.corners().map(|corner| {
        let nearest = second.nearest(to_b(corner));
        Candidate {
            on_first: corner,
            on_second: to_a(nearest.point),
            normal: b_turn.of(nearest.normal),
            gap: nearest.distance,
            follows: if nearest.on_face { Follows::Second } else { Follows::Nothing },
        }
    });
    let of_second = second.corners().map(|corner| {
        let corner = to_a(corner);
        let nearest = first.nearest(corner);
        Candidate {
            on_first: nearest.point,
            on_second: corner,
            normal: -nearest.normal,
            gap: nearest.distance,
            follows: if nearest.on_face { Follows::First } else { Follows::Nothing },
        }
    });
    let mut count = 0;
    for (place, candidate) in room.iter_mut().zip(of_first.chain(of_second)) {
        *place = candidate;
        count += 1;
    }
    let found = &room[..count];
    let nearer = |p: &&Candidate, q: &&Candidate| p.gap.total_cmp(&q.gap);
    let Some(best) = found.iter().min_by(nearer) else { return ([None, None], 0) };
    if best.gap < THROUGH {
        let outlines = (Outline::of(first.corners()), Outline::of(second.corners().map(to_a)));
        let through = |sunk: &Sunk| sunk.ends[0].2 < best.gap.min(0.0) - THROUGH;
        if let Some(sunk) = sunk(&outlines.0, &outlines.1).filter(through) {
            return through_a_face(&sunk, (a, turn), reach);
        }
    }
    if best.gap > reach {
        return ([None, None], 0);
    }
    let next = found
        .iter()
        .filter(|p| {
            (p.on_first - best.on_first).norm() > SAME_POINT
                && (p.on_second - best.on_second).norm() > SAME_POINT
        })
        .min_by(nearer)
        .filter(|p| p.gap <= reach);
    // If corners of both coincide, neither face alone leads. Two corners appear twice, once from
    // either body, and rounding must not decide which of both leads.
    let led = |p: &Candidate| {
        let other = |q: &&Candidate| q.follows != p.follows && q.follows != Follows::Nothing;
        let near = if p.follows == Follows::Nothing { ROUNDING } else { SAME_POINT };
        match (p.follows, found.iter().filter(other).find(|q| p.is_at(q, near))) {
            (alone, None) => alone,
            (Follows::Nothing, Some(faced)) => faced.follows,
            _ => Follows::Both,
        }
    };
    let world = |p: &Candidate| ContactPoint {
        on_first: a.position + turn.of(p.on_first),
        on_second: a.position + turn.of(p.on_second),
        normal: turn.of(p.normal),
        gap: p.gap,
        follows: led(p),
    };
    ([Some(world(best)), next.map(world)], 1 + usize::from(next.is_some()))
}

/// Returns the contact of shapes of which one has passed through a face of the other; the first is
/// at `pose`.
fn through_a_face(
    sunk: &Sunk,
    (pose, turn): (&Pose, &Turn),
    reach: f64,
) -> ([Option<ContactPoint>; 2], usize) {
    let world = |(on_first, on_second, gap): (Vector, Vector, f64)| ContactPoint {
        on_first: pose.position + turn.of(on_first),
        on_second: pose.position + turn.of(on_second),
        normal: turn.of(sunk.normal),
        gap,
        follows: match (sunk.parallel, sunk.by_first) {
            (true, _) => Follows::Both,
            (false, true) => Follows::First,
            (false, false) => Follows::Second,
        },
    };
    let [best, next] = sunk.ends.map(world);
    let apart = (best.on_first - next.on_first).norm() > SAME_POINT;
    let next = Some(next).filter(|point| apart && point.gap <= reach);
    match best.gap <= reach {
        true => ([Some(best), next], 1 + usize::from(next.is_some())),
        false => ([None, None], 0),
    }
}

#[cfg(test)]
mod tests;
