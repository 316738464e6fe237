//! Nodes whose motion is given: the parts of the tool, which the end effector moves, and obstacles.
//!
//! The parts of a tool are one body: fixed joints pass the end effector's motion on to each of them,
//! and what touches one of them feels all of it. A learned message over such a joint would make
//! another tool of one that is built of other parts; so what these relations say is in closed form:
//! every part has the extent and the motion of the whole tool. Nothing that a body with a given motion
//! hears can change that motion, so it only speaks.

use crate::{
    contact::FrameSolution,
    geometry::{Footprint, Pose, Vector, perpendicular},
    task::FrameStep,
};

/// A tool or an obstacle in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// Whether it is the tool.
    pub tool: bool,
    /// Middle of what it covers, between its ends along and across the tool's motion; world, metres.
    pub middle: Vector,
    /// From there to its ends along and across the tool's motion, metres.
    pub half: [f64; 2],
    /// How far that middle moves during the frame, metres.
    pub shift: Vector,
    /// How far it turns during the frame, radians.
    pub turn: f64,
}

impl Given {
    /// The tool in a frame.
    pub fn tool(frame: &FrameSolution<'_>) -> Self {
        let FrameStep { from, to, .. } = *frame.step;
        let pieces = frame.bodies.outline.iter();
        let (middle, half) =
            extent(frame.axis, pieces.map(|(footprint, pose)| (footprint, from * *pose)));
        let moved = to.point(from.local_point(middle)) - middle;
        Self { tool: true, middle, half, shift: moved, turn: to.heading - from.heading }
    }

    /// Obstacle `index` of those at hand in a frame.
    pub fn obstacle(frame: &FrameSolution<'_>, index: usize) -> Self {
        let obstacle = &frame.bodies.obstacles[index];
        let covered = std::iter::once((&obstacle.footprint, obstacle.pose));
        let (middle, half) = extent(frame.axis, covered);
        Self { tool: false, middle, half, shift: Vector::zeros(), turn: 0.0 }
    }
}

/// Middle and halves of the smallest rectangle along `axis` that holds all of these.
fn extent<'a>(
    axis: Vector,
    bodies: impl Iterator<Item = (&'a Footprint, Pose)>,
) -> (Vector, [f64; 2]) {
    let axes = [axis, perpendicular(axis)];
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (footprint, pose) in bodies {
        for (k, direction) in axes.into_iter().enumerate() {
            let centre = pose.position.dot(&direction);
            high[k] = high[k].max(centre + footprint.extent(pose.local_vector(direction)));
            low[k] = low[k].min(centre - footprint.extent(pose.local_vector(-direction)));
        }
    }
    let at = |k: usize| (low[k] + high[k]) / 2.0;
    (axes[0] * at(0) + axes[1] * at(1), [0, 1].map(|k| (high[k] - low[k]) / 2.0))
}
