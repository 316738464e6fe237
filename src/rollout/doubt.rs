//! What a rollout shows about itself that no real table does.

use crate::{
    contact::{Bodies, Jointed},
    geometry::{Footprint, Pose, contact_points, wrap_angle},
    scene::{Body, JointKind, State},
};

/// Bodies deeper inside each other than this are worth a word, metres. What the network
/// leaves of an overlap in sound predictions is mostly below half a millimetre.
pub(super) const DEEP: f64 = 0.002;

/// Joints that end farther from what they allow are worth a word, metres: a thousand times what
/// the projection leaves where it converges.
const LOOSE: f64 = 1e-3;

/// An overlap above which the tool counts as set down on an object, metres: the simulator's.
const TOUCHING: f64 = 1e-4;

/// Length that turns a joint's angle into metres.
const ARM: f64 = 0.05;

/// The deepest overlap of an object that `moved` with another body, deeper than [`DEEP`]: the
/// object, the body, and the depth in metres. The tool's frame is at `tool`.
pub(super) fn deepest_overlap(
    bodies: &Bodies,
    state: &State,
    tool: &Pose,
    moved: impl Fn(usize) -> bool,
) -> Option<(usize, Body, f64)> {
    let mut deepest = None;
    let mut meet = |object: usize, with: Body, footprint: &Footprint, pose: &Pose| {
        let own = (&bodies.objects[object].footprint, &state.poses[object]);
        let depth = contact_points(own, (footprint, pose), -DEEP).0[0].map(|point| -point.gap);
        if let Some(depth) = depth
            && deepest.is_none_or(|(_, _, most)| depth > most)
        {
            deepest = Some((object, with, depth));
        }
    };
    for (object, body) in bodies.objects.iter().enumerate().filter(|(k, _)| moved(*k)) {
        for (k, other) in bodies.objects.iter().enumerate() {
            if bodies.mechanisms[k] != bodies.mechanisms[object] && !(moved(k) && k < object) {
                meet(object, Body::Object(k), &other.footprint, &state.poses[k]);
            }
        }
        for (k, obstacle) in bodies.obstacles.iter().enumerate() {
            meet(object, Body::Obstacle(k), &obstacle.footprint, &obstacle.pose);
        }
        for (k, part) in bodies.parts.iter().enumerate() {
            if part.span.0 < body.height {
                meet(object, Body::Part(k), &part.footprint, &(*tool * part.pose));
            }
        }
    }
    deepest
}

/// The objects that a tool set down at `tool` stands on.
pub(super) fn set_down_on<'a>(
    bodies: &'a Bodies,
    state: &'a State,
    tool: &'a Pose,
) -> impl Iterator<Item = usize> + 'a {
    let stands_on = move |&object: &usize| {
        let body = &bodies.objects[object];
        bodies.parts.iter().filter(|part| part.span.0 < body.height).any(|part| {
            let own = (&body.footprint, &state.poses[object]);
            contact_points(own, (&part.footprint, &(*tool * part.pose)), -TOUCHING).1 > 0
        })
    };
    (0..bodies.objects.len()).filter(stands_on)
}

/// The joint farthest from what it allows, farther than [`LOOSE`], with an object that `moved`:
/// its objects and how far, metres (turns at 5 cm).
pub(super) fn loosest_joint(
    bodies: &Bodies,
    state: &State,
    moved: impl Fn(usize) -> bool,
) -> Option<([usize; 2], f64)> {
    let mut loosest = None;
    let counts = |joint: &&Jointed| !joint.guessed && joint.between.iter().any(|&k| moved(k));
    for joint in bodies.joints.iter().filter(counts) {
        let off = off(joint, state);
        if off > LOOSE && loosest.is_none_or(|(_, most)| off > most) {
            loosest = Some((joint.between, off));
        }
    }
    loosest
}

/// How far a joint is from what it allows, metres (turns at 5 cm).
fn off(joint: &Jointed, state: &State) -> f64 {
    let [first, second] = [0, 1].map(|end| state.poses[joint.between[end]] * joint.frames[end]);
    let apart = first.local_point(second.position);
    let turn = wrap_angle(second.heading - first.heading);
    let beyond = |value: f64| {
        joint.limits.map_or(0.0, |limits| (value - value.clamp(limits.low, limits.high)).abs())
    };
    match joint.kind {
        JointKind::Fixed => apart.norm().max(ARM * turn.abs()),
        JointKind::Revolute { .. } => apart.norm().max(ARM * beyond(turn)),
        JointKind::Prismatic { .. } => apart.y.abs().max(ARM * turn.abs()).max(beyond(apart.x)),
    }
}
