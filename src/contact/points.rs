//! Contact points of bodies close enough to matter in a frame, each pair once.

use crate::{
    geometry::{
        ContactPoint, Follows, Placed, Pose, Turn, Vector, contact_points_of, far_apart, wrap_angle,
    },
    scene::State,
    task::FrameStep,
};
use pushplan_kernel::Motion;

use super::{
    bodies::{Bodies, Partner, PrescribedBody},
    pairs::PairId,
};

/// Gap, beyond the possible travel of both bodies in the frame, up to which a pair is related,
/// metres: a margin for the rotation of long bodies.
pub const MARGIN: f64 = 0.008;

/// A contact point of an object with another body. World axes, metres.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Persistent id of the two bodies.
    pub pair: PairId,
    /// Index of the first object.
    pub object: usize,
    /// The other body: an object of a higher index, or a body with prescribed motion.
    pub with: Partner,
    /// Vector from the object's centre to its contact point.
    pub arm: Vector,
    /// Vector from the other centre to its contact point; zero for prescribed motion.
    pub other_arm: Vector,
    /// Unit normal, from the other body into the object.
    pub normal: Vector,
    /// Distance along the normal, negative where the bodies overlap.
    pub gap: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Displacement of the contact point on a body with prescribed motion.
    pub given: Vector,
    /// Rotation of that body, radians.
    pub(super) given_turn: f64,
    /// The body or bodies with which the normal rotates.
    pub(super) follows: Follows,
}

/// The data on which a frame's contacts depend.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scenery<'a> {
    pub bodies: &'a Bodies,
    pub state: &'a State,
    pub step: &'a FrameStep,
    pub coasts: &'a [Motion],
    /// Rotations by the objects' headings.
    pub turns: &'a [Turn],
    /// Maximum gap of a contact beyond the possible travel of both bodies, metres.
    pub margin: f64,
}

/// Precomputed motion of the tool in a frame.
struct Pusher {
    from: Turn,
    to: Turn,
    /// Rotation during the frame, radians.
    turned: f64,
}

impl Pusher {
    fn new(step: &FrameStep) -> Self {
        let turned = wrap_angle(step.to.heading - step.from.heading);
        Self { from: step.from.turn(), to: step.to.turn(), turned }
    }
}

/// Finds every contact point close enough to matter in this frame. Objects of one rigid group do
/// not touch each other.
pub(super) fn find_contacts(scenery: Scenery, contacts: &mut Vec<Contact>) {
    let bodies = scenery.bodies;
    contacts.clear();
    let tool = Pusher::new(scenery.step);
    for (object, body) in bodies.objects.iter().enumerate() {
        let placed = scenery.placed(object);
        let mut meet = |with| {
            let reach = scenery.reach(object, with);
            scenery.meet(&tool, (object, &placed), (with, reach), contacts);
        };
        for (index, part) in bodies.parts.iter().enumerate() {
            if body.meets(part.span) {
                meet(Partner::Part(index));
            }
        }
        for (index, obstacle) in bodies.obstacles.iter().enumerate() {
            if body.meets(obstacle.span) {
                meet(Partner::Obstacle(index));
            }
        }
        for other in object + 1..bodies.objects.len() {
            let apart = bodies.groups.of[object] != bodies.groups.of[other];
            if apart && body.meets(bodies.objects[other].span) {
                meet(Partner::Object(other));
            }
        }
    }
}

/// Finds the contact points of the pairs in `known`. `known` belongs to an earlier state, since
/// which no point of an object has moved by more than its entry in `moved`.
pub(super) fn find_again(
    scenery: Scenery,
    known: &[Contact],
    moved: &[f64],
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    let tool = Pusher::new(scenery.step);
    // The points of a pair are adjacent, the nearest first.
    for points in known.chunk_by(|one, next| one.pair == next.pair) {
        let Contact { object, with, gap, .. } = points[0];
        let nearer = match with {
            // The nearest point may lie on a seam, which does not count.
            Partner::Part(_) => f64::INFINITY,
            Partner::Obstacle(_) => moved[object],
            Partner::Object(other) => moved[object] + moved[other],
        };
        let reach = scenery.reach(object, with);
        if gap - nearer <= reach {
            let placed = scenery.placed(object);
            scenery.meet(&tool, (object, &placed), (with, reach), contacts);
        }
    }
}

impl Scenery<'_> {
    /// Returns an object in its initial pose.
    fn placed(&self, object: usize) -> Placed<'_> {
        let footprint = &self.bodies.objects[object].footprint;
        Placed::turned(footprint, self.state.poses[object], self.turns[object])
    }

    /// Returns the maximum gap at which points of an object and another body count, metres.
    fn reach(&self, object: usize, with: Partner) -> f64 {
        let Self { bodies, step, coasts, .. } = *self;
        let travel = (step.to.position - step.from.position).norm();
        let own = |object: usize| {
            coasts[object].shift.norm() + coasts[object].turn.abs() * bodies.objects[object].radius
        };
        // The far ends of a rotating tool travel more than its frame; margins allow for that.
        let reach = self.margin + travel + own(object);
        match with {
            Partner::Object(other) => reach + own(other),
            _ => reach,
        }
    }

    /// Adds the contact points of an object and another body that are within `reach` metres.
    fn meet(
        &self,
        tool: &Pusher,
        (object, placed): (usize, &Placed),
        (with, reach): (Partner, f64),
        contacts: &mut Vec<Contact>,
    ) {
        let Self { bodies, step, .. } = *self;
        let other = match with {
            Partner::Part(index) => {
                let PrescribedBody { footprint, pose: Pose { position, heading }, turn, .. } =
                    &bodies.parts[index];
                let position = step.from.position + tool.from.of(*position);
                let pose = Pose { position, heading: step.from.heading + heading };
                Placed::turned(footprint, pose, tool.from.after(turn))
            }
            Partner::Obstacle(index) => {
                let PrescribedBody { footprint, pose, turn, .. } = &bodies.obstacles[index];
                Placed::turned(footprint, *pose, *turn)
            }
            Partner::Object(other) => self.placed(other),
        };
        if far_apart(placed, &other, reach) {
            return;
        }
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
                    Partner::Object(_) => point.on_second - other.position(),
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

#[cfg(test)]
mod tests;
