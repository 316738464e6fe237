//! What stands on the table where something is levered.

use serde::{Deserialize, Serialize};

use crate::geometry::Pose;
use crate::scene::Obstacle;

use super::Plate;

/// The flat end of a tool that goes under an edge: a cuboid from its tip backwards.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Blade {
    /// Along the shaft, metres.
    pub length: f64,
    /// Along the edge, metres.
    pub width: f64,
    /// Metres; must fit below the edge.
    pub thickness: f64,
    /// Friction value.
    pub friction: f64,
}

/// A cuboid fixed to the table: a wall, a standoff, the floor of a tray.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// Unique within the scene.
    pub name: String,
    /// Full extents, metres.
    pub size: [f64; 3],
    /// Its middle seen from above.
    pub pose: Pose,
    /// Height of its underside above the table, metres.
    pub z: f64,
    /// Friction value.
    pub friction: f64,
}

impl Block {
    /// What pushes must keep away from: the block down to the table.
    pub fn obstacle(&self) -> Obstacle {
        let [x, y, z] = self.size;
        Obstacle::new(&self.name, [x, y, self.z + z], self.pose).friction(self.friction)
    }
}

/// Plates, what is fixed around them, and the blade.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverScene {
    /// What can move; a lever names one of them.
    pub plates: Vec<Plate>,
    /// What cannot.
    pub blocks: Vec<Block>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// The lever.
    pub blade: Blade,
}
