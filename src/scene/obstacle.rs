//! What does not move: it stands on the table, or is fixed above it.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, Shape, Solid};

use super::planar::{is_zero, planar_only};

/// A fixed cuboid: a wall, a shelf, a standoff, the floor of a tray.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    /// Unique among objects and obstacles.
    pub name: String,
    /// Full extents, metres.
    pub size: [f64; 3],
    /// Where it is: its middle seen from above.
    pub pose: Pose,
    /// Height of its underside above the table, metres.
    #[serde(with = "planar_only", default, skip_serializing_if = "is_zero")]
    pub z: f64,
    /// Friction value.
    pub friction: f64,
}

impl Obstacle {
    /// Friction value of an obstacle that states none: plain wood.
    pub const FRICTION: f64 = 0.5;

    /// A fixed cuboid of these full extents (metres), of the table's usual friction value.
    pub fn new(name: impl Into<String>, size: [f64; 3], pose: Pose) -> Self {
        Self { name: name.into(), size, pose, z: 0.0, friction: Self::FRICTION }
    }

    /// The obstacle with its underside this high above the table, metres.
    ///
    /// ```
    /// use pushplan::{Obstacle, Pose};
    ///
    /// let shelf = Obstacle::new("shelf", [0.3, 0.6, 0.02], Pose::new(0.7, 0.0, 0.0)).raised(0.15);
    /// assert!(shelf.meets([0.0, 0.2]) && !shelf.meets([0.0, 0.1]));
    /// ```
    pub fn raised(self, z: f64) -> Self {
        Self { z, ..self }
    }

    /// Height of its top above the table, metres.
    pub fn top(&self) -> f64 {
        self.z + self.size[2]
    }

    /// Whether what is between these two heights above the table is as high as some of it.
    pub fn meets(&self, [low, high]: [f64; 2]) -> bool {
        low < self.top() && self.z < high
    }

    /// Where it is, as a solid in space.
    pub fn solid(&self) -> Solid {
        let middle = Pose3::upright(self.pose, self.z + 0.5 * self.size[2]);
        Solid::cuboid(self.size, &middle)
    }

    /// What pushes must keep away from: the obstacle down to the table.
    pub fn grounded(&self) -> Self {
        let [x, y, _] = self.size;
        Self { size: [x, y, self.top()], z: 0.0, ..self.clone() }
    }

    /// The obstacle with another friction value.
    pub fn friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// Its solid.
    pub fn shape(&self) -> Shape {
        Shape::Cuboid { size: self.size }
    }
}
