//! Contacts: points of two bodies close enough to matter in a frame, each pair once.

use crate::{
    geometry::{ContactPoint, Vector, contact_points},
    scene::{Body, FrameStep, Scene, State},
};

use super::bodies::{Bodies, Motion};

/// Pairs count as related when their gap is at most this beyond what both could travel in the
/// frame, metres: room for the turning of long bodies.
pub const MARGIN: f64 = 0.008;

/// A contact point of an object with another body. World axes, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// The first object.
    pub object: usize,
    /// The other body; an object of a higher index, or one whose motion is given.
    pub with: Body,
    /// From the object's centre to the point on it.
    pub arm: Vector,
    /// From the other's centre to the point on it; zero where its motion is given.
    pub other_arm: Vector,
    /// Unit, from the other body into the object.
    pub normal: Vector,
    pub gap: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Displacement of the point on a body whose motion is given.
    pub given: Vector,
}

/// Every contact point close enough to matter in this frame. Objects of one rigid group do not
/// touch each other.
pub(super) fn find_contacts(
    bodies: &Bodies,
    state: &State,
    step: &FrameStep,
    coasts: &[Motion],
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    let still = step.from == step.to;
    // While the tool turns, its far ends travel more than its frame; margins allow for that.
    let travel = (step.to.position - step.from.position).norm();
    let own = |object: usize| {
        let body = &bodies.objects[object];
        coasts[object].shift.norm() + coasts[object].turn.abs() * body.radius
    };
    for (object, body) in bodies.objects.iter().enumerate() {
        let pose = &state.poses[object];
        let mut add = |point: &ContactPoint, with, friction, given, centre: Option<Vector>| {
            contacts.push(Contact {
                object,
                with,
                arm: point.on_first - pose.position,
                other_arm: centre.map_or(Vector::zeros(), |centre| point.on_second - centre),
                normal: point.normal,
                gap: point.gap,
                friction: Scene::pair_friction(body.friction, friction),
                given,
            });
        };
        let reach = MARGIN + travel + own(object);
        for (index, part) in bodies.parts.iter().enumerate() {
            if part.span.0 >= body.height {
                continue;
            }
            let part_pose = step.from * part.pose;
            let other = (&part.footprint, &part_pose);
            for point in contact_points((&body.footprint, pose), other, reach).0.iter().flatten() {
                let given = if still {
                    Vector::zeros()
                } else {
                    step.to.point(step.from.local_point(point.on_second)) - point.on_second
                };
                add(point, Body::Part(index), part.friction, given, None);
            }
        }
        for (index, obstacle) in bodies.obstacles.iter().enumerate() {
            let other = (&obstacle.footprint, &obstacle.pose);
            for point in contact_points((&body.footprint, pose), other, reach).0.iter().flatten() {
                let with = Body::Obstacle(index);
                add(point, with, obstacle.friction, Vector::zeros(), None);
            }
        }
        for other in object + 1..bodies.objects.len() {
            if bodies.groups.of[object] == bodies.groups.of[other] {
                continue;
            }
            let reach = reach + own(other);
            let at = &state.poses[other];
            let second = (&bodies.objects[other].footprint, at);
            for point in contact_points((&body.footprint, pose), second, reach).0.iter().flatten() {
                let friction = bodies.objects[other].friction;
                add(point, Body::Object(other), friction, Vector::zeros(), Some(at.position));
            }
        }
    }
}
