//! From a state and a frame of tool motion to the nodes and relations of its graph.

use crate::{
    geometry::{ContactPoint, Vector, contact_points, perpendicular},
    scene::{Body, FrameStep, Scene, State},
};

use super::{
    batch::{Batch, KINEMATIC, Node, Touch},
    bodies::{Bodies, Motion},
    coast::coast,
    features::{UNIT, node_features, relation_features},
    push::{Twist, contact_twist},
};

/// Pairs count as related when their gap is at most this beyond what both could travel in the
/// frame, metres: room for the turning of long bodies.
const MARGIN: f64 = 0.008;

/// Sweeps of the prior over the contacts; what they leave is for the network to correct.
const SWEEPS: usize = 6;

/// Overlap at which a contact counts fully in the prior, in [`UNIT`]s: well below what noise
/// in a rollout produces.
const SOFT_OVERLAP: f64 = 0.01;

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

/// Adds the graph of one frame to `batch` under the number `graph`, and fills `motions` with
/// what every object of the scene does if it is left alone. Those that the network decides
/// have a node; the others keep their entry in `motions`, which for them is exact.
///
/// `axis` is the unit vector of the tool's motion, the last one while it stands still.
pub fn add_graph(
    bodies: &Bodies,
    state: &State,
    step: &FrameStep,
    axis: Vector,
    graph: u32,
    batch: &mut Batch,
    motions: &mut Vec<Motion>,
) {
    motions.clear();
    motions.extend(
        bodies
            .objects
            .iter()
            .zip(&state.velocities)
            .map(|(body, velocity)| coast(body, velocity, step.duration)),
    );
    let mut links = find_links(bodies, state, step, motions);
    if links.is_empty() {
        return;
    }
    let awake = awake(&links, motions, step);
    if !awake.contains(&true) {
        return;
    }
    links.retain(|link| awake[link.receiver]);
    let priors = quasi_statics(bodies, &mut links, motions, step.duration);

    let first = batch.node_count() as u32;
    let mut index = vec![KINEMATIC; bodies.objects.len()];
    let mut count = 0;
    for (object, body) in bodies.objects.iter().enumerate() {
        if !awake[object] {
            continue;
        }
        index[object] = first + count;
        count += 1;
        let mut node = Node {
            graph,
            object: object as u32,
            axis,
            duration: step.duration,
            support: body.support,
            prior: [0.0; 6],
        };
        node.prior = node.encode(&priors[object]);
        let pressed: f64 =
            links.iter().filter(|l| l.receiver == object).map(|l| l.overlap).sum::<f64>() / UNIT;
        let (even, odd) = node_features(&node, body, &motions[object], pressed);
        batch.push_node(node, even, odd);
    }
    for link in &links {
        let receiver = index[link.receiver];
        let sender = match link.sender {
            Body::Object(sender) => index[sender],
            _ => KINEMATIC,
        };
        let (even, odd) = relation_features(&batch.nodes[receiver as usize], link);
        batch.push_relation(receiver, sender, even, odd);
        if link.overlap > 0.0 {
            batch.touches.push(Touch { graph, object: link.receiver, with: link.sender });
        }
    }
}

/// Every contact point close enough to matter in this frame, once for each receiver.
fn find_links(bodies: &Bodies, state: &State, step: &FrameStep, coasts: &[Motion]) -> Vec<Link> {
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

/// Which objects may do anything but coast: those near a moving part, those that move near
/// anything, and those related to such an object.
fn awake(links: &[Link], coasts: &[Motion], step: &FrameStep) -> Vec<bool> {
    let tool_moves = step.from != step.to;
    let moving = |object: usize| coasts[object] != Motion::default();
    let mut awake = vec![false; coasts.len()];
    for link in links {
        let pushed = matches!(link.sender, Body::Part(_)) && tool_moves;
        if pushed || moving(link.receiver) {
            awake[link.receiver] = true;
        }
    }
    loop {
        let mut changed = false;
        for link in links {
            if let Body::Object(sender) = link.sender
                && awake[sender]
                && !awake[link.receiver]
            {
                awake[link.receiver] = true;
                changed = true;
            }
        }
        if !changed {
            return awake;
        }
    }
}

/// Fills the links' quasi-static answers and returns every object's prior motion: coasting,
/// plus in every sweep what its contacts still ask for, weighted by the squares of the
/// overlaps that are left.
///
/// This is projected Jacobi iteration without the memory of earlier impulses; weights that sum
/// to at most one keep it from overshooting, and make it independent of the contacts' order.
fn quasi_statics(
    bodies: &Bodies,
    links: &mut [Link],
    coasts: &[Motion],
    duration: f64,
) -> Vec<Motion> {
    let mut priors = coasts.to_vec();
    let mut pressed = vec![0.0; coasts.len()];
    let mut asked = vec![(Twist::default(), 0.0); links.len()];
    let soft = (SOFT_OVERLAP * UNIT).powi(2);
    for sweep in 0..SWEEPS {
        pressed.fill(0.0);
        for (link, asked) in links.iter_mut().zip(&mut asked) {
            *asked = ask(bodies, link, coasts, &priors, sweep == 0);
            pressed[link.receiver] += asked.1 * asked.1;
        }
        if pressed.iter().all(|&p| p <= soft) && sweep > 0 {
            break;
        }
        for (link, (twist, overlap)) in links.iter_mut().zip(&asked) {
            let weight = overlap * overlap / (pressed[link.receiver] + soft);
            if sweep == 0 {
                link.weight = weight;
            }
            let prior = &mut priors[link.receiver];
            prior.shift += twist.shift * weight;
            prior.turn += twist.turn * weight;
        }
    }
    end_velocities(bodies, links, &mut priors, duration);
    priors
}

/// Brings the velocities at the frame's end to what the contacts made in it allow, by the same
/// sweeps: in contact, a point moves with what pushes it.
fn end_velocities(bodies: &Bodies, links: &[Link], priors: &mut [Motion], duration: f64) {
    let soft = (SOFT_OVERLAP * UNIT).powi(2);
    let mut pressed = vec![0.0; priors.len()];
    let mut asked = vec![(Twist::default(), 0.0); links.len()];
    for _ in 0..SWEEPS {
        pressed.fill(0.0);
        for (link, asked) in links.iter().zip(&mut asked) {
            *asked = (Twist::default(), 0.0);
            if link.overlap <= 0.0 {
                continue;
            }
            let sent = match link.sender {
                Body::Object(sender) => priors[sender].velocity_at(link.sender_arm) * duration,
                _ => link.given,
            };
            let relative = sent - priors[link.receiver].velocity_at(link.arm) * duration;
            let closing = relative.dot(&link.normal).max(0.0);
            let c = bodies.objects[link.receiver].support;
            let twist = contact_twist(c, link.arm, link.normal, relative, link.friction);
            *asked = (twist, closing);
            pressed[link.receiver] += closing * closing;
        }
        if pressed.iter().all(|&p| p <= soft) {
            return;
        }
        for (link, (twist, closing)) in links.iter().zip(&asked) {
            let weight = closing * closing / (pressed[link.receiver] + soft) / duration;
            priors[link.receiver].velocity += twist.shift * weight;
            priors[link.receiver].spin += twist.turn * weight;
        }
    }
}

/// The twist that one contact alone still asks its receiver for beyond `priors`, and the
/// overlap left there, metres. In the first sweep this also fills the link's own description.
fn ask(
    bodies: &Bodies,
    link: &mut Link,
    coasts: &[Motion],
    priors: &[Motion],
    first: bool,
) -> (Twist, f64) {
    let sent = match link.sender {
        Body::Object(sender) => priors[sender].at(link.sender_arm),
        _ => link.given,
    };
    let free = sent - coasts[link.receiver].at(link.arm);
    let closing = free.dot(&link.normal);
    // An object that is itself pushed against another pushes it, not the other way round; how
    // far the other slows it is left to the network.
    let passive = matches!(link.sender, Body::Object(_)) && closing <= link.gap.max(0.0);
    let relative = sent - priors[link.receiver].at(link.arm);
    let left = relative.dot(&link.normal) - link.gap;
    let overlap = if passive { 0.0 } else { left.max(0.0) };
    link.relative = free;
    link.remaining =
        if closing > link.gap.max(0.0) { 1.0 - link.gap.max(0.0) / closing } else { 0.0 };
    let across = relative.dot(&perpendicular(link.normal)) * link.remaining;
    let displacement = link.normal * overlap + perpendicular(link.normal) * across;
    let c = bodies.objects[link.receiver].support;
    let twist = contact_twist(c, link.arm, link.normal, displacement, link.friction);
    if first || overlap > link.overlap {
        link.overlap = overlap;
        link.answer = twist;
        let moved = twist.shift + twist.turn * perpendicular(link.arm);
        link.slip = (displacement - moved).dot(&perpendicular(link.normal)).abs();
    }
    (twist, overlap)
}
