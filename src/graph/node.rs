//! A node: an object whose motion the network decides, and the units of that motion.

use crate::{
    contact::{ListIndex, Motion},
    geometry::Vector,
    outcome::Spread,
    scene::FRAME_TRAVEL,
};

/// Unit of displacements and gaps, metres: one frame of tool travel.
pub const UNIT: f64 = FRAME_TRAVEL;

/// One object whose motion the network decides.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Which graph of the batch, as the caller numbered it.
    pub graph: u32,
    /// Which of the frame's objects.
    pub object: ListIndex,
    /// Unit vector of the tool's motion: the x axis of every feature and output of this graph.
    pub axis: Vector,
    /// Duration of the frame, seconds.
    pub duration: f64,
    /// Length c of the object's limit surface, metres.
    pub support: f64,
    /// The prior's motion, in output units: even shift x, velocity x; odd shift y,
    /// turn, velocity y, spin.
    pub prior: [f64; 6],
}

/// What a network changes of a node's prior, and how far from the truth it expects to be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// Added to [`Node::prior`], output units.
    pub output: [f64; 6],
    /// How much this frame adds to the error that is expected at the end, output units: of the
    /// position, and of the heading; if the network says so.
    pub doubt: Option<[f64; 2]>,
}

impl Node {
    /// A doubt of position and heading, from output units to metres and radians.
    pub fn decode_doubt(&self, [position, heading]: [f64; 2]) -> Spread {
        Spread { position: position * UNIT, heading: heading * UNIT / self.support }
    }

    /// A motion in output units and this node's axes: lengths over `UNIT`, velocities times
    /// the frame's duration over `UNIT`, turns times c over `UNIT`.
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

    /// The motion that six output numbers mean.
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
