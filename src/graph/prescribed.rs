//! Graph nodes with prescribed motion: the parts of the tool, which the end effector moves, and
//! obstacles.
//!
//! Fixed joints propagate additive states over the parts of a tool, and over obstacles that touch,
//! until every part holds the state of its whole body (see [`crate::contact::PrescribedBody`]). The
//! joints also pass the end effector's motion on. The nodes of a tool's parts are therefore equal
//! and share one row of the tables. A body with prescribed motion only sends messages, because no
//! received message can change its motion.

use crate::{
    contact::{FrameSolution, PrescribedBody},
    geometry::{AreaMoments, Vector},
    task::FrameStep,
};

/// A tool or an obstacle in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrescribedNode {
    /// Whether the body is the tool, not an obstacle.
    pub tool: bool,
    /// Area of the whole body, square metres.
    pub area: f64,
    /// Mean squares and products of the distances of its area from the centroid, along and across
    /// the tool's motion: along-along, along-across and across-across, square metres.
    pub spread: [f64; 3],
    /// Displacement of the centroid during the frame, metres.
    pub shift: Vector,
    /// Rotation during the frame, radians.
    pub turn: f64,
}

impl PrescribedNode {
    /// Returns the node of a tool part in a frame.
    pub fn part(frame: &FrameSolution<'_>, part: &PrescribedBody) -> Self {
        let FrameStep { from, to, .. } = *frame.step;
        let AreaMoments { area, .. } = part.body;
        let centre = part.body.centre();
        Self {
            tool: true,
            area,
            spread: part.body.spread(from.local_vector(frame.axis)),
            shift: to.point(centre) - from.point(centre),
            turn: to.heading - from.heading,
        }
    }

    /// Returns the node of an obstacle in a frame.
    pub fn obstacle(frame: &FrameSolution<'_>, obstacle: &PrescribedBody) -> Self {
        Self {
            tool: false,
            area: obstacle.body.area,
            spread: obstacle.body.spread(frame.axis),
            shift: Vector::zeros(),
            turn: 0.0,
        }
    }
}
