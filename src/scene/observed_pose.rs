//! The observed pose of an object.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};

/// An observation of an object's pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObservedPose {
    /// Position of its centre, metres.
    pub position: Vector,
    /// Heading, radians, up to whole turns; `None` if it is not observable.
    pub heading: Option<f64>,
}

impl ObservedPose {
    /// Creates the observation of a pose, with or without its heading.
    pub fn new(pose: &Pose, heading: bool) -> Self {
        Self { position: pose.position, heading: heading.then_some(pose.heading) }
    }
}
