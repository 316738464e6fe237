//! What a rollout shows about itself that cannot happen on a real table.

use crate::{
    contact::{Bodies, Jointed},
    geometry::{Footprint, Pose, contact_points},
    scene::{Body, JOINT_ARM, JointKind, Misfit, State},
};

/// Bodies deeper inside each other than this are reported, metres. What the network
/// leaves of an overlap in sound predictions is mostly below half a millimetre.
pub(super) const DEEP: f64 = 0.002;

/// Joints that end farther from what they allow are reported, metres: a thousand times what
/// the projection leaves where it converges.
const LOOSE: f64 = 1e-3;

/// An object, the body it is inside of, and how deep, metres.
pub(super) type Overlap = (usize, Body, f64);

/// The deepest overlaps of a rollout.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Depths {
    /// Of any two bodies, deeper than [`DEEP`].
    any: Option<Overlap>,
    /// Of bodies that jam so deep in each other, see [`Body::most_overlap`].
    pub jam: Option<Overlap>,
}

impl Depths {
    /// Notes an overlap; whether it is the first that jams.
    pub fn note(&mut self, object: usize, with: Body, depth: f64) -> bool {
        let deeper = |known: Option<Overlap>| known.is_none_or(|(_, _, most)| depth > most);
        if depth > DEEP && deeper(self.any) {
            self.any = Some((object, with, depth));
        }
        let first = self.jam.is_none();
        let jams = depth > with.most_overlap() && deeper(self.jam);
        if jams {
            self.jam = Some((object, with, depth));
        }
        jams && first
    }

    /// Notes the overlaps of objects that `moved`. The tool's frame is at `tool`.
    pub fn note_all(
        &mut self,
        bodies: &Bodies,
        state: &State,
        tool: &Pose,
        moved: impl Fn(usize) -> bool,
    ) {
        let mut meet = |object: usize, with: Body, footprint: &Footprint, pose: &Pose| {
            let own = (&bodies.objects[object].footprint, &state.poses[object]);
            if let Some(point) = contact_points(own, (footprint, pose), -DEEP).0[0] {
                self.note(object, with, -point.gap);
            }
        };
        for (object, body) in bodies.objects.iter().enumerate().filter(|(k, _)| moved(*k)) {
            for (k, other) in bodies.objects.iter().enumerate() {
                let apart = bodies.mechanisms[k] != bodies.mechanisms[object];
                if apart && body.meets(other.span) && !(moved(k) && k < object) {
                    meet(object, Body::Object(k), &other.footprint, &state.poses[k]);
                }
            }
            for (k, obstacle) in bodies.obstacles.iter().enumerate() {
                if body.meets(obstacle.span) {
                    meet(object, Body::Obstacle(k), &obstacle.footprint, &obstacle.pose);
                }
            }
            for (k, part) in bodies.parts.iter().enumerate() {
                if body.meets(part.span) {
                    meet(object, Body::Part(k), &part.footprint, &(*tool * part.pose));
                }
            }
        }
    }

    /// The deepest overlap, where it is not that of bodies that jam.
    pub fn sunk(&self) -> Option<Overlap> {
        self.any.filter(|any| self.jam != Some(*any))
    }
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
    let Misfit { offset, turn } = joint.separation(&state.poses).misfit(&joint.kind, joint.limits);
    let apart = match joint.kind {
        JointKind::Prismatic { .. } => offset.amax(),
        _ => offset.norm(),
    };
    apart.max(JOINT_ARM * turn.abs())
}
