//! Graph nodes with prescribed motion: the tool, which the end effector moves, and obstacles.
//!
//! The parts of a tool are one body: fixed joints pass the end effector's motion on to each of
//! them, and a touched object feels the whole tool. A learned message over such a joint would
//! depend on how the tool is divided into parts. These relations are therefore in closed form:
//! every part has the extent and the motion of the whole tool. A body with prescribed motion only
//! sends messages, because no received message can change its motion.

use crate::{
    contact::FrameSolution,
    geometry::{Footprint, Pose, Vector, perpendicular},
    task::FrameStep,
};

/// A tool or an obstacle in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrescribedNode {
    /// Whether the body is the tool, not an obstacle.
    pub tool: bool,
    /// Middle of the covered area, between its ends along and across the tool's motion; world,
    /// metres.
    pub middle: Vector,
    /// Distances from the middle to the ends along and across the tool's motion, metres.
    pub half: [f64; 2],
    /// Displacement of the middle during the frame, metres.
    pub shift: Vector,
    /// Rotation during the frame, radians.
    pub turn: f64,
}

impl PrescribedNode {
    /// Returns the tool in a frame.
    pub fn tool(frame: &FrameSolution<'_>) -> Self {
        let FrameStep { from, to, .. } = *frame.step;
        let pieces = frame.bodies.outline.iter();
        let (middle, half) =
            extent(frame.axis, pieces.map(|(footprint, pose)| (footprint, from * *pose)));
        let moved = to.point(from.local_point(middle)) - middle;
        Self { tool: true, middle, half, shift: moved, turn: to.heading - from.heading }
    }

    /// Returns obstacle `index` among the obstacles of a frame.
    pub fn obstacle(frame: &FrameSolution<'_>, index: usize) -> Self {
        let obstacle = &frame.bodies.obstacles[index];
        let covered = std::iter::once((&obstacle.footprint, obstacle.pose));
        let (middle, half) = extent(frame.axis, covered);
        Self { tool: false, middle, half, shift: Vector::zeros(), turn: 0.0 }
    }
}

/// Returns the middle and half extents of the smallest rectangle along `axis` that contains all
/// `bodies`.
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
