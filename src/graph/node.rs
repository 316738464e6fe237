//! Nodes: objects whose motion the network corrects, and the units of that motion.

use crate::{
    contact::{ListIndex, Motion},
    geometry::Vector,
    scene::FRAME_TRAVEL,
};

/// Number of readouts, one for each engine that states no height of contact: the 3-D engine and
/// MuJoCo.
pub const READOUTS: usize = 2;

/// Unit of displacements and gaps, metres: one frame of tool travel.
pub const UNIT: f64 = FRAME_TRAVEL;

/// An object whose motion the network corrects.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Number of the graph in the batch, assigned by the caller.
    pub graph: u32,
    /// Index of the object in the frame's list.
    pub object: ListIndex,
    /// Unit vector of the tool's motion: the x axis of every feature and output of this graph.
    pub axis: Vector,
    /// Duration of the frame, seconds.
    pub duration: f64,
    /// Length c of the object's limit surface, metres.
    pub support: f64,
    /// Motion in the analytic model, output units: even displacement x, velocity x; odd
    /// displacement y, rotation, velocity y, angular velocity.
    pub prior: [f64; 6],
}

/// A network's correction of a node's motion, relative to the length of that motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// Change of the displacements along and across the tool's motion, and of the rotation at the
    /// support's length c, of every readout. A change of 1 is as long as the motion itself, see
    /// [`Node::length`].
    pub readouts: [[f64; 3]; READOUTS],
    /// Change by a head that was fitted to a table, likewise.
    pub head: [f64; 3],
    /// Expected errors of position and of heading (at the support's length). `None` for a network
    /// that does not estimate errors.
    pub doubt: Option<[f64; 2]>,
}

/// Corrections of the nodes of a batch.
#[derive(Clone, Debug, Default)]
pub struct Corrections {
    /// Correction of every node, `[N]`.
    pub nodes: Vec<Correction>,
    /// Share of the distance between readouts that counts as expected error of position and of
    /// heading.
    pub apart: [f64; 2],
}

impl Node {
    /// Returns the length of the node's analytic motion in the frame, metres: displacement of the
    /// centre, and rotation at the support's length.
    pub fn length(&self) -> f64 {
        let [x, _, y, turn, ..] = self.prior;
        UNIT * (x.hypot(y) + turn.abs())
    }

    /// Converts a motion into output units and this node's axes: lengths over `UNIT`, velocities
    /// times the frame's duration over `UNIT`, rotations times c over `UNIT`.
    pub fn encode(&self, motion: &Motion) -> [f64; 6] {
        let (ax, ay) = (self.axis.x, self.axis.y);
        let along = |v: Vector| (ax * v.x + ay * v.y) / UNIT;
        let across = |v: Vector| (ax * v.y - ay * v.x) / UNIT;
        [
            along(motion.shift),
            along(motion.velocity) * self.duration,
            across(motion.shift),
            motion.turn * self.support / UNIT,
            across(motion.velocity) * self.duration,
            motion.spin * self.duration * self.support / UNIT,
        ]
    }
}
