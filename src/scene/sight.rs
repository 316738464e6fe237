//! The observed pose of an object.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};

/// Where an object was seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sight {
    /// Position of its centre, metres.
    pub position: Vector,
    /// Heading, radians, up to whole turns; `None` where it cannot be told.
    pub heading: Option<f64>,
}

impl Sight {
    /// A pose as it was seen, with or without its heading.
    pub fn new(pose: &Pose, heading: bool) -> Self {
        Self { position: pose.position, heading: heading.then_some(pose.heading) }
    }
}
