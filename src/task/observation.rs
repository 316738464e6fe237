//! Observations of a table while a tool moves on it.

use crate::scene::ObservedPose;
use serde::{Deserialize, Serialize};

use super::Stroke;

/// The tool motion since the previous observation, and the observed poses after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Strokes of the tool, in order of time.
    pub strokes: Vec<Stroke>,
    /// Observation of every object of the scene; `None` if it was not observed.
    pub seen: Vec<Option<ObservedPose>>,
}

/// Standard deviations of independent normal observation errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Standard deviation of either coordinate of a position, metres.
    pub position: f64,
    /// Standard deviation of a heading, radians.
    pub heading: f64,
}
