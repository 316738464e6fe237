//! Contacts: points of two bodies close enough to matter in a frame, each pair once.

use crate::{
    geometry::{ContactPoint, Follows, Vector, contact_points, wrap_angle},
    scene::{FrameStep, State},
};

use super::{
    bodies::{Bodies, Partner},
    motion::Motion,
    pairs::PairId,
};

/// Pairs count as related when their gap is at most this beyond what both could travel in the
/// frame, metres: room for the turning of long bodies.
pub const MARGIN: f64 = 0.008;

/// A contact point of an object with another body. World axes, metres.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// The two bodies over all frames.
    pub pair: PairId,
    /// The first object.
    pub object: usize,
    /// The other body; an object of a higher number, or one whose motion is given.
    pub with: Partner,
    /// From the object's centre to the point on it.
    pub arm: Vector,
    /// From the other's centre to the point on it; zero where its motion is given.
    pub other_arm: Vector,
    /// Unit, from the other body into the object.
    pub normal: Vector,
    /// Distance along the normal, negative where the bodies overlap.
    pub gap: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Displacement of the point on a body whose motion is given.
    pub given: Vector,
    /// Turn of that body, radians.
    pub(super) given_turn: f64,
    /// What the normal turns with.
    pub(super) follows: Follows,
}

/// What a frame's contacts depend on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scenery<'a> {
    pub bodies: &'a Bodies,
    pub state: &'a State,
    pub step: &'a FrameStep,
    pub coasts: &'a [Motion],
    /// How much farther off than both could travel what still counts may be, metres.
    pub margin: f64,
}

/// Every contact point close enough to matter in this frame. Objects of one rigid group do not
/// touch each other.
pub(super) fn find_contacts(scenery: Scenery, contacts: &mut Vec<Contact>) {
    let bodies = scenery.bodies;
    contacts.clear();
    for (object, body) in bodies.objects.iter().enumerate() {
        for (index, part) in bodies.parts.iter().enumerate() {
            if part.span.0 < body.height {
                scenery.meet(object, Partner::Part(index), contacts);
            }
        }
        for index in 0..bodies.obstacles.len() {
            scenery.meet(object, Partner::Obstacle(index), contacts);
        }
        for other in object + 1..bodies.objects.len() {
            if bodies.groups.of[object] != bodies.groups.of[other] {
                scenery.meet(object, Partner::Object(other), contacts);
            }
        }
    }
}

/// The contact points of those pairs alone that have some in `known`.
pub(super) fn find_again(scenery: Scenery, known: &[Contact], contacts: &mut Vec<Contact>) {
    contacts.clear();
    let mut last = None;
    for contact in known {
        // The points of a pair stand together.
        if last.replace(contact.pair) != Some(contact.pair) {
            scenery.meet(contact.object, contact.with, contacts);
        }
    }
}

impl Scenery<'_> {
    /// Adds the contact points of an object and another body.
    fn meet(&self, object: usize, with: Partner, contacts: &mut Vec<Contact>) {
        let Self { bodies, state, step, coasts, .. } = *self;
        let travel = (step.to.position - step.from.position).norm();
        let own = |object: usize| {
            coasts[object].shift.norm() + coasts[object].turn.abs() * bodies.objects[object].radius
        };
        // While the tool turns, its far ends travel more than its frame; margins allow for that.
        let reach = self.margin + travel + own(object);
        let body = &bodies.objects[object];
        let pose = &state.poses[object];
        let part_pose;
        let (other, reach) = match with {
            Partner::Part(index) => {
                let part = &bodies.parts[index];
                part_pose = step.from * part.pose;
                ((&part.footprint, &part_pose), reach)
            }
            Partner::Obstacle(index) => {
                let obstacle = &bodies.obstacles[index];
                ((&obstacle.footprint, &obstacle.pose), reach)
            }
            Partner::Object(other) => {
                let second = &bodies.objects[other];
                let at = &state.poses[other];
                ((&second.footprint, at), reach + own(other))
            }
        };
        let pair = bodies.pair(object, with);
        let shows = |point: &&ContactPoint| match with {
            Partner::Part(index) => bodies.shows(index, other.1, point),
            _ => true,
        };
        let points = contact_points((&body.footprint, pose), other, reach).0;
        for point in points.iter().flatten().filter(shows) {
            let (given, given_turn) = match with {
                Partner::Part(_) if step.from != step.to => (
                    step.to.point(step.from.local_point(point.on_second)) - point.on_second,
                    wrap_angle(step.to.heading - step.from.heading),
                ),
                _ => (Vector::zeros(), 0.0),
            };
            contacts.push(Contact {
                pair,
                object,
                with,
                arm: point.on_first - pose.position,
                other_arm: match with {
                    Partner::Object(_) => point.on_second - other.1.position,
                    _ => Vector::zeros(),
                },
                normal: point.normal,
                gap: point.gap,
                friction: bodies.friction(object, with),
                given,
                given_turn,
                follows: point.follows,
            });
        }
    }
}
