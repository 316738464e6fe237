//! The names of bodies that touch.

use serde::{Deserialize, Serialize};

/// Largest gap of bodies that touch, metres; also the largest overlap that is a mere touch.
pub const TOUCHING: f64 = 1e-4;

/// A body that a contact names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Body {
    /// Index into the scene's objects.
    Object(usize),
    /// Index into the scene's obstacles.
    Obstacle(usize),
    /// Index into the pieces of the tool's outline.
    Part(usize),
}

impl Body {
    /// Returns the overlap above which an object is jammed in this body, metres; rigid bodies do
    /// not reach it.
    ///
    /// Obstacles are hardly entered: 0 mm in 300 solved random tasks, and 2.5 mm and more for
    /// objects squeezed through gaps that are too narrow. Light objects in front of heavy ones sink
    /// into the pushing body. In 3-D an object of 0.1 kg in front of three of 1 kg sinks 3.1 mm
    /// into the tool and 4.4 mm into its neighbour.
    pub fn most_overlap(&self) -> f64 {
        match self {
            Body::Obstacle(_) => 2e-3,
            Body::Part(_) => 5e-3,
            Body::Object(_) => 8e-3,
        }
    }
}
