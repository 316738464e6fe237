//! Parts of tools.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Shape};

/// One solid of a tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Unique within the tool.
    pub name: String,
    /// Its solid, upright: a cuboid, or a cylinder for a round finger or hand.
    pub shape: Shape,
    /// Pose of the centre in the tool frame.
    pub pose: Pose,
}

impl Part {
    /// A solid with its centre at `pose` in the tool frame.
    pub fn new(name: impl Into<String>, shape: Shape, pose: Pose) -> Self {
        Self { name: name.into(), shape, pose }
    }

    /// A cuboid of these full extents (metres) with its centre at `pose` in the tool frame.
    pub fn cuboid(name: impl Into<String>, size: [f64; 3], pose: Pose) -> Self {
        Self::new(name, Shape::Cuboid { size }, pose)
    }

    /// Outline that it covers on the table.
    pub fn footprint(&self) -> Footprint {
        self.shape.footprint()
    }
}
