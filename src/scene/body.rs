//! The names of bodies that touch.

use serde::{Deserialize, Serialize};

/// Bodies with a smaller gap than this touch, metres; the same depth of overlap is no more than a
/// touch.
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
    /// An object deeper inside such a body than this is jammed, metres: rigid ones do not get
    /// there.
    ///
    /// Nothing comes into an obstacle: over 300 solved random tasks 0 mm, squeezed through gaps too
    /// narrow 2.5 mm and more. Light objects in front of heavy ones do sink into what pushes them:
    /// in 3-D one of 0.1 kg in front of three of 1 kg sinks 3.1 mm into the tool and 4.4 mm into
    /// its neighbour.
    pub fn most_overlap(&self) -> f64 {
        match self {
            Body::Obstacle(_) => 2e-3,
            Body::Part(_) => 5e-3,
            Body::Object(_) => 8e-3,
        }
    }
}
