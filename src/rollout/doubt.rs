//! Violations of a rollout that cannot occur on a real table.

use crate::{
    contact::{Bodies, Jointed},
    geometry::{Footprint, Pose, contact_points},
    scene::{Body, JOINT_ARM, JointKind, Misfit, State},
};

/// Penetration beyond which bodies are reported, metres. Overlaps that remain in sound predictions
/// of the network are mostly below half a millimetre.
pub(super) const DEEP: f64 = 0.002;

/// Violation of a joint beyond which it is reported, metres: a thousand times the residual of a
/// converged projection.
const LOOSE: f64 = 1e-3;

/// An object, the body that it penetrates, and the depth, metres.
pub(super) type Overlap = (usize, Body, f64);

/// The deepest overlaps of a rollout.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Depths {
    /// Deepest overlap of any two bodies, if deeper than [`DEEP`].
    any: Option<Overlap>,
    /// Deepest overlap at which bodies jam, see [`Body::most_overlap`].
    pub jam: Option<Overlap>,
}

impl Depths {
    /// Records an overlap; returns `true` if it is the first that jams.
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

    /// Records the overlaps of objects that `moved`. The tool's frame is at `tool`.
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

    /// Returns the deepest overlap, unless it is the jam.
    pub fn sunk(&self) -> Option<Overlap> {
        self.any.filter(|any| self.jam != Some(*any))
    }
}

/// Returns the objects of the joint with the largest violation beyond [`LOOSE`] among those with an
/// object that `moved`, and the violation, metres (rotations at 5 cm).
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

/// Returns the violation of a joint, metres (rotations at 5 cm).
fn off(joint: &Jointed, state: &State) -> f64 {
    let Misfit { offset, turn } = joint.separation(&state.poses).misfit(&joint.kind, joint.limits);
    let apart = match joint.kind {
        JointKind::Prismatic { .. } => offset.amax(),
        _ => offset.norm(),
    };
    apart.max(JOINT_ARM * turn.abs())
}
