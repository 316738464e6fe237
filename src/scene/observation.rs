//! What is seen of a table while a tool moves on it.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};

use super::Stroke;

/// What the tool did since the observation before, and where things were seen then.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// What the tool did, in order of time.
    pub strokes: Vec<Stroke>,
    /// Every object of the scene; `None` where it was not seen.
    pub seen: Vec<Option<Sight>>,
}

/// Where an object was seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sight {
    /// Position of its centre, metres.
    pub position: Vector,
    /// Heading, radians, up to whole turns; `None` where it cannot be told.
    pub heading: Option<f64>,
}

/// Errors of what is seen: standard deviations of independent normal errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Of either coordinate of a position, metres.
    pub position: f64,
    /// Of a heading, radians.
    pub heading: f64,
}

impl Sight {
    /// A pose as it was seen, with or without its heading.
    pub fn new(pose: &Pose, heading: bool) -> Self {
        Self { position: pose.position, heading: heading.then_some(pose.heading) }
    }
}
