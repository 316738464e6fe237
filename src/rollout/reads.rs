//! The frames of a rollout that the network reads: every second one with a moving object.

use crate::{
    contact::{Bodies, Motion, SceneIndex},
    geometry::Vector,
};

use super::{correction::Read, stepper::Found};

/// Motions read so far, and the nodes to which the coming motions belong.
#[derive(Clone, Debug)]
pub(super) struct Reads {
    /// Whether the next frame with an awake object is read.
    pub next: bool,
    /// Node of every object of the scene in the frame read last, if the coming frame belongs to it.
    nodes: Vec<Option<u32>>,
    pub all: Vec<Read>,
}

impl Reads {
    /// Starts a rollout of a scene with this many objects.
    pub fn new(objects: usize) -> Self {
        Self { next: true, nodes: vec![None; objects], all: Vec::new() }
    }

    /// Records the nodes of a frame; `objects` are the listed objects.
    pub fn note(&mut self, found: &Found<'_>, objects: &[SceneIndex]) {
        if self.next || found.awake == 0 {
            self.nodes.fill(None);
            for (k, node) in found.nodes.iter().enumerate() {
                self.nodes[objects[node.object.0].0] = Some((found.first + k) as u32);
            }
        }
        self.next = found.nodes.is_empty();
    }

    /// Records the motions of a frame between two recorded `frames`, along the `axis` of the tool's
    /// motion; `bodies` are the listed ones.
    pub fn advance(
        &mut self,
        motions: &[Motion],
        bodies: &Bodies,
        frames: [usize; 2],
        axis: Vector,
    ) {
        for (motion, body) in motions.iter().zip(&bodies.objects) {
            let object = body.index.0;
            let length = motion.shift.norm() + body.support * motion.turn.abs();
            if let Some(node) = self.nodes[object].filter(|_| length > 0.0) {
                self.all.push(Read {
                    node,
                    object: object as u32,
                    frames: frames.map(|frame| frame as u32),
                    length,
                    axis,
                    support: body.support,
                });
            }
        }
    }
}
