//! Nodes: objects whose motion the network corrects, and the units of that motion.

use crate::{
    contact::{ListIndex, Motion},
    geometry::Vector,
    outcome::Spread,
    scene::FRAME_TRAVEL,
};

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

/// A network's correction of a node's analytic motion, with its expected error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// Change added to [`Node::prior`], output units.
    pub output: [f64; 6],
    /// Contribution of this frame to the expected final error of position and heading, output
    /// units. `None` for a network that does not estimate errors.
    pub doubt: Option<[f64; 2]>,
}

impl Node {
    /// Converts an expected error of position and heading from output units to metres and radians.
    pub fn decode_doubt(&self, [position, heading]: [f64; 2]) -> Spread {
        Spread { position: position * UNIT, heading: heading * UNIT / self.support }
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

    /// Converts six output numbers into a motion.
    pub fn decode(&self, output: &[f64; 6]) -> Motion {
        let world = |x: f64, y: f64| {
            Vector::new(self.axis.x * x - self.axis.y * y, self.axis.y * x + self.axis.x * y) * UNIT
        };
        Motion {
            shift: world(output[0], output[2]),
            turn: output[3] * UNIT / self.support,
            velocity: world(output[1], output[4]) / self.duration,
            spin: output[5] * UNIT / (self.support * self.duration),
        }
    }
}
