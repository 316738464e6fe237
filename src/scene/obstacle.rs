//! Fixed bodies on the table or above it.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, Shape, Solid};

use super::serde_planar::{is_zero, planar_only};

/// A fixed cuboid: a wall, a shelf, a standoff, the floor of a tray.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    /// Name, unique among objects and obstacles.
    pub name: String,
    /// Full extents, metres.
    pub size: [f64; 3],
    /// Pose of its centre, seen from above.
    pub pose: Pose,
    /// Height of its underside above the table, metres.
    #[serde(with = "planar_only", default, skip_serializing_if = "is_zero")]
    pub z: f64,
    /// Friction value.
    pub friction: f64,
}

impl Obstacle {
    /// Beginning of the names of obstacles that are the robot's own body.
    pub const ROBOT: &str = "robot base";

    /// Default friction value of an obstacle: plain wood.
    pub const FRICTION: f64 = 0.5;

    /// Creates a fixed cuboid at the origin with these full extents (metres) and the default
    /// friction value.
    pub fn cuboid(name: impl Into<String>, size: [f64; 3]) -> Self {
        Self { name: name.into(), size, pose: Pose::default(), z: 0.0, friction: Self::FRICTION }
    }

    /// Puts its centre at (`x`, `y`), metres, with this `heading`, radians.
    pub fn at(self, x: f64, y: f64, heading: f64) -> Self {
        Self { pose: Pose::new(x, y, heading), ..self }
    }

    /// Puts its underside at this height above the table, metres.
    ///
    /// ```
    /// use pushplan::Obstacle;
    ///
    /// let shelf = Obstacle::cuboid("shelf", [0.3, 0.6, 0.02]).at(0.7, 0.0, 0.0).raised(0.15);
    /// assert!(shelf.meets([0.0, 0.2]) && !shelf.meets([0.0, 0.1]));
    /// ```
    pub fn raised(self, z: f64) -> Self {
        Self { z, ..self }
    }

    /// Returns `true` if it is part of the robot's own body.
    pub fn is_robot(&self) -> bool {
        self.name.starts_with(Self::ROBOT)
    }

    /// Returns the height of its top above the table, metres.
    pub fn top(&self) -> f64 {
        self.z + self.size[2]
    }

    /// Returns `true` if it overlaps this range of heights above the table, metres.
    pub fn meets(&self, [low, high]: [f64; 2]) -> bool {
        low < self.top() && self.z < high
    }

    /// Returns it as a 3-D solid.
    pub fn solid(&self) -> Solid {
        let middle = Pose3::upright(self.pose, self.z + 0.5 * self.size[2]);
        Solid::cuboid(self.size, &middle)
    }

    /// Returns the obstacle extended down to the table, from which pushes keep away.
    pub fn grounded(&self) -> Self {
        let [x, y, _] = self.size;
        Self { size: [x, y, self.top()], z: 0.0, ..self.clone() }
    }

    /// Sets the friction value.
    pub fn friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// Returns its solid.
    pub fn shape(&self) -> Shape {
        Shape::Cuboid { size: self.size }
    }
}
