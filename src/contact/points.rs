//! Contacts: points of two bodies close enough to matter in a frame, each pair once.

use crate::{
    geometry::{
        ContactPoint, Follows, Placed, Pose, Turn, Vector, contact_points_of, far_apart, wrap_angle,
    },
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

/// What everything in a frame needs of the tool.
struct Pusher {
    from: Turn,
    to: Turn,
    /// How far it turns, radians.
    turned: f64,
}

impl Pusher {
    fn new(step: &FrameStep) -> Self {
        let turned = wrap_angle(step.to.heading - step.from.heading);
        Self { from: step.from.turn(), to: step.to.turn(), turned }
    }
}

/// Every contact point close enough to matter in this frame. Objects of one rigid group do not
/// touch each other.
pub(super) fn find_contacts(scenery: Scenery, contacts: &mut Vec<Contact>) {
    let bodies = scenery.bodies;
    contacts.clear();
    let tool = Pusher::new(scenery.step);
    for (object, body) in bodies.objects.iter().enumerate() {
        let placed = Placed::new(&body.footprint, scenery.state.poses[object]);
        let mut meet = |with| scenery.meet(&tool, (object, &placed), with, contacts);
        for (index, part) in bodies.parts.iter().enumerate() {
            if part.span.0 < body.height {
                meet(Partner::Part(index));
            }
        }
        for index in 0..bodies.obstacles.len() {
            meet(Partner::Obstacle(index));
        }
        for other in object + 1..bodies.objects.len() {
            if bodies.groups.of[object] != bodies.groups.of[other] {
                meet(Partner::Object(other));
            }
        }
    }
}

/// The contact points of those pairs alone that have some in `known`.
pub(super) fn find_again(scenery: Scenery, known: &[Contact], contacts: &mut Vec<Contact>) {
    contacts.clear();
    let tool = Pusher::new(scenery.step);
    let mut last = None;
    for contact in known {
        // The points of a pair stand together.
        if last.replace(contact.pair) != Some(contact.pair) {
            let body = &scenery.bodies.objects[contact.object];
            let placed = Placed::new(&body.footprint, scenery.state.poses[contact.object]);
            scenery.meet(&tool, (contact.object, &placed), contact.with, contacts);
        }
    }
}

impl Scenery<'_> {
    /// Adds the contact points of an object and another body.
    fn meet(
        &self,
        tool: &Pusher,
        (object, placed): (usize, &Placed),
        with: Partner,
        contacts: &mut Vec<Contact>,
    ) {
        let Self { bodies, state, step, coasts, .. } = *self;
        let travel = (step.to.position - step.from.position).norm();
        let own = |object: usize| {
            coasts[object].shift.norm() + coasts[object].turn.abs() * bodies.objects[object].radius
        };
        // While the tool turns, its far ends travel more than its frame; margins allow for that.
        let reach = self.margin + travel + own(object);
        let (footprint, pose, reach) = match with {
            Partner::Part(index) => {
                let part = &bodies.parts[index];
                let Pose { position, heading } = part.pose;
                let position = step.from.position + tool.from.of(position);
                (&part.footprint, Pose { position, heading: step.from.heading + heading }, reach)
            }
            Partner::Obstacle(index) => {
                let obstacle = &bodies.obstacles[index];
                (&obstacle.footprint, obstacle.pose, reach)
            }
            Partner::Object(other) => {
                (&bodies.objects[other].footprint, state.poses[other], reach + own(other))
            }
        };
        let body = &bodies.objects[object].footprint;
        if far_apart((body, placed.position()), (footprint, pose.position), reach) {
            return;
        }
        let other = Placed::new(footprint, pose);
        let shows = |point: &&ContactPoint| match with {
            Partner::Part(index) => bodies.shows(index, &other, point),
            _ => true,
        };
        let pair = bodies.pair(object, with);
        let points = contact_points_of(placed, &other, reach).0;
        for point in points.iter().flatten().filter(shows) {
            let (given, given_turn) = match with {
                Partner::Part(_) if step.from != step.to => {
                    let local = tool.from.back(point.on_second - step.from.position);
                    (step.to.position + tool.to.of(local) - point.on_second, tool.turned)
                }
                _ => (Vector::zeros(), 0.0),
            };
            contacts.push(Contact {
                pair,
                object,
                with,
                arm: point.on_first - placed.position(),
                other_arm: match with {
                    Partner::Object(_) => point.on_second - pose.position,
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
