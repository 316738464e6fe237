//! What is seen of a table while a tool moves on it.

use crate::scene::Sight;
use serde::{Deserialize, Serialize};

use super::Stroke;

/// What the tool did since the observation before, and where things were seen then.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// What the tool did, in order of time.
    pub strokes: Vec<Stroke>,
    /// Every object of the scene; `None` where it was not seen.
    pub seen: Vec<Option<Sight>>,
}

/// Errors of what is seen: standard deviations of independent normal errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Of either coordinate of a position, metres.
    pub position: f64,
    /// Of a heading, radians.
    pub heading: f64,
}
