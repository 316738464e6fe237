//! Links: contact points close enough to matter in a frame, as their receivers see them.

use crate::{
    geometry::{ContactPoint, Vector, contact_points},
    scene::{Body, FrameStep, Scene, State},
};

use super::{
    bodies::{Bodies, Motion},
    push::Twist,
};

/// Pairs count as related when their gap is at most this beyond what both could travel in the
/// frame, metres: room for the turning of long bodies.
const MARGIN: f64 = 0.008;

/// A contact point as its receiver sees it. World axes, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub receiver: usize,
    pub sender: Body,
    /// From the receiver's centre to the point on it.
    pub arm: Vector,
    /// From the sender's centre to the point on it; zero where its motion is given.
    pub sender_arm: Vector,
    /// Unit, into the receiver.
    pub normal: Vector,
    pub gap: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Natural logarithm of the sender's mass over the receiver's; zero where it is given.
    pub mass_ratio: f64,
    pub sender_support: f64,
    /// Displacement of the point on a sender whose motion is given.
    pub given: Vector,
    /// Displacement of the sender's point against the coasting receiver's.
    pub relative: Vector,
    /// How far the bodies would overlap if the receiver only coasted.
    pub overlap: f64,
    /// Share of the frame left after the gap has closed.
    pub remaining: f64,
    /// The receiver's motion if this were its only contact, beyond coasting.
    pub answer: Twist,
    /// Displacement of the sender's point along the receiver's surface in that motion.
    pub slip: f64,
    /// Share of this contact in the receiver's prior.
    pub weight: f64,
}

/// Every contact point close enough to matter in this frame, once for each receiver.
pub(super) fn find_links(
    bodies: &Bodies,
    state: &State,
    step: &FrameStep,
    coasts: &[Motion],
) -> Vec<Link> {
    let mut links = Vec::new();
    let travel = (step.to.position - step.from.position).norm();
    let own = |object: usize| {
        let body = &bodies.objects[object];
        coasts[object].shift.norm() + coasts[object].turn.abs() * body.radius
    };
    for (object, body) in bodies.objects.iter().enumerate() {
        let pose = &state.poses[object];
        for (index, part) in bodies.parts.iter().enumerate() {
            if part.span.0 >= body.height {
                continue;
            }
            let part_pose = step.from * part.pose;
            let reach = MARGIN + travel + own(object);
            let (points, _) =
                contact_points((&body.footprint, pose), (&part.footprint, &part_pose), reach);
            for point in points.into_iter().flatten() {
                let given = if travel == 0.0 && step.from.heading == step.to.heading {
                    Vector::zeros()
                } else {
                    step.to.point(step.from.local_point(point.on_second)) - point.on_second
                };
                links.push(link_to_given(
                    bodies,
                    object,
                    pose.position,
                    &point,
                    part.friction,
                    Body::Part(index),
                    given,
                ));
            }
        }
        for (index, obstacle) in bodies.obstacles.iter().enumerate() {
            let reach = MARGIN + travel + own(object);
            let (points, _) = contact_points(
                (&body.footprint, pose),
                (&obstacle.footprint, &obstacle.pose),
                reach,
            );
            for point in points.into_iter().flatten() {
                links.push(link_to_given(
                    bodies,
                    object,
                    pose.position,
                    &point,
                    obstacle.friction,
                    Body::Obstacle(index),
                    Vector::zeros(),
                ));
            }
        }
        for other in object + 1..bodies.objects.len() {
            let reach = MARGIN + travel + own(object) + own(other);
            let (points, _) = contact_points(
                (&body.footprint, pose),
                (&bodies.objects[other].footprint, &state.poses[other]),
                reach,
            );
            for point in points.into_iter().flatten() {
                links.push(link_between(bodies, state, object, other, &point));
                links.push(link_between(bodies, state, other, object, &point.flipped()));
            }
        }
    }
    links
}

fn link_to_given(
    bodies: &Bodies,
    receiver: usize,
    centre: Vector,
    point: &ContactPoint,
    friction: f64,
    sender: Body,
    given: Vector,
) -> Link {
    Link {
        receiver,
        sender,
        arm: point.on_first - centre,
        sender_arm: Vector::zeros(),
        normal: point.normal,
        gap: point.gap,
        friction: Scene::pair_friction(bodies.objects[receiver].friction, friction),
        mass_ratio: 0.0,
        sender_support: 0.0,
        given,
        relative: Vector::zeros(),
        overlap: 0.0,
        remaining: 1.0,
        answer: Twist::default(),
        slip: 0.0,
        weight: 0.0,
    }
}

fn link_between(
    bodies: &Bodies,
    state: &State,
    receiver: usize,
    sender: usize,
    point: &ContactPoint,
) -> Link {
    let (to, from) = (&bodies.objects[receiver], &bodies.objects[sender]);
    let centre = state.poses[receiver].position;
    Link {
        sender_arm: point.on_second - state.poses[sender].position,
        mass_ratio: (from.mass / to.mass).ln(),
        sender_support: from.support,
        ..link_to_given(
            bodies,
            receiver,
            centre,
            point,
            from.friction,
            Body::Object(sender),
            Vector::zeros(),
        )
    }
}
