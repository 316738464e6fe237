//! Geometry of a contact at an instant within a frame.
//!
//! Normals rotate while bodies move. With initial normals a solution is exact to first order only:
//! a disc pushed by a disc leaves sideways, and each frame would push it slightly too straight.
//! Normals at half the frame make the change of every gap exact to second order, because
//! (|q| - |p|) = (q - p) . (p + q) / (|p| + |q|) and the last factor is the direction at half the
//! frame.

use crate::{
    geometry::{Follows, Footprint, Turn, Vector},
    scene::State,
};
use pushplan_kernel::settings::NEAR;

use super::{
    bodies::{Bodies, Partner},
    points::Contact,
    unknown::Unknown,
};

/// Contact geometry at an instant of a frame. World axes, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Midpoint {
    /// Unit normal, from the other body into the object.
    pub normal: Vector,
    /// Vector from the centre of the object's group to the contact point.
    pub arm: Vector,
    /// Vector from the centre of the other group to the contact point; zero for prescribed motion.
    pub other_arm: Vector,
}

/// Returns the geometry of `contact` after a `share` of the frame's motion.
#[inline]
pub(super) fn midpoint(
    bodies: &Bodies,
    state: &State,
    contact: &Contact,
    unknowns: &[Unknown],
    share: f64,
) -> Midpoint {
    let side = |object: usize, arm: Vector| {
        let position = state.poses[object].position;
        let moves = Moves::With(&unknowns[bodies.groups.of[object].0]);
        Side::new(&bodies.objects[object].footprint, moves, position + arm, position)
    };
    let first = side(contact.object, contact.arm);
    let second = match contact.with {
        Partner::Object(other) => side(other, contact.other_arm),
        with => {
            let normal = contact.normal;
            let point = state.poses[contact.object].position + contact.arm - contact.gap * normal;
            let footprint = match with {
                Partner::Part(index) => &bodies.parts[index].footprint,
                // Obstacles do not move, so only faces and corners matter.
                _ => &Footprint::Rectangle { half: Vector::new(0.0, 0.0) },
            };
            let radius = if let Footprint::Disc { radius } = footprint { *radius } else { 0.0 };
            let turn = Turn::by(share * contact.given_turn);
            let moves = Moves::Prescribed { about: point, by: share * contact.given, turn };
            Side::new(footprint, moves, point, point - radius * normal)
        }
    };
    let normal = match contact.follows {
        Follows::Nothing => contact.normal,
        Follows::First => first.moves.turn().of(contact.normal),
        Follows::Second => second.moves.turn().of(contact.normal),
        Follows::Both => {
            let [first, second] = [first, second].map(|side| side.moves.turn().of(contact.normal));
            (first + second).normalize()
        }
        Follows::Between(p, q) => {
            let between = first.moves.moved(p) - second.moves.moved(q);
            let (before, now) = ((p - q).norm(), between.norm());
            let usable = before.min(now) > NEAR && between.dot(&contact.normal) > 0.5 * now;
            if usable { between / now } else { contact.normal }
        }
    };
    // A face is touched at the current position of the other body's point.
    let (p, q) = match contact.follows {
        Follows::First => (second.point(normal), second.point(normal)),
        Follows::Second => (first.point(-normal), first.point(-normal)),
        _ => (first.point(-normal), second.point(normal)),
    };
    Midpoint { normal, arm: p - first.moves.centre(), other_arm: q - second.moves.centre() }
}

/// Motion of one of the two bodies.
#[derive(Clone, Copy)]
enum Moves<'a> {
    With(&'a Unknown),
    /// Prescribed motion: a point of the body, its displacement, and the rotation.
    Prescribed {
        about: Vector,
        by: Vector,
        turn: Turn,
    },
}

impl Moves<'_> {
    #[inline]
    fn turn(&self) -> Turn {
        match self {
            Self::With(unknown) => unknown.turn,
            Self::Prescribed { turn, .. } => *turn,
        }
    }

    /// Returns the current position of a point of the body.
    #[inline]
    fn moved(&self, point: Vector) -> Vector {
        match self {
            Self::With(unknown) => unknown.moved(point),
            Self::Prescribed { about, by, turn } => about + by + turn.of(point - about),
        }
    }

    /// Returns the current position of the reference point of arms.
    #[inline]
    fn centre(&self) -> Vector {
        match self {
            Self::With(unknown) => unknown.moved(unknown.centre),
            Self::Prescribed { about, by, .. } => about + by,
        }
    }
}

/// A body of the contact.
#[derive(Clone, Copy)]
struct Side<'a> {
    moves: Moves<'a>,
    /// Initial contact point.
    point: Vector,
    /// Initial centre and radius of a disc.
    round: Option<(Vector, f64)>,
}

impl<'a> Side<'a> {
    #[inline]
    fn new(footprint: &Footprint, moves: Moves<'a>, point: Vector, centre: Vector) -> Self {
        let round = match *footprint {
            Footprint::Disc { radius } => Some((centre, radius)),
            Footprint::Rectangle { .. } | Footprint::Polygon(_) => None,
        };
        Self { moves, point, round }
    }

    /// Returns the contact point on the body. The point of a disc stays in the direction `outward`
    /// from its centre; a corner moves with the body.
    #[inline]
    fn point(&self, outward: Vector) -> Vector {
        match self.round {
            Some((centre, radius)) => self.moves.moved(centre) + radius * outward,
            None => self.moves.moved(self.point),
        }
    }
}
