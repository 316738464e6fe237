//! Parts of tools.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Shape};

/// A solid of a tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Name, unique within the tool.
    pub name: String,
    /// Solid, upright: a cuboid, or a cylinder for a round finger or hand.
    pub shape: Shape,
    /// Pose of the centre in the tool frame.
    pub pose: Pose,
}

impl Part {
    /// Creates a solid with its centre at `pose` in the tool frame.
    pub fn new(name: impl Into<String>, shape: Shape, pose: Pose) -> Self {
        Self { name: name.into(), shape, pose }
    }

    /// Creates a cuboid with these full extents (metres) and its centre at `pose` in the tool
    /// frame.
    pub fn cuboid(name: impl Into<String>, size: [f64; 3], pose: Pose) -> Self {
        Self::new(name, Shape::Cuboid { size }, pose)
    }

    /// Returns its outline on the table.
    pub fn footprint(&self) -> Footprint {
        self.shape.footprint()
    }
}
