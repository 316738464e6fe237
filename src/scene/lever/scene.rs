//! A scene in space, as it is levered in.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose3, Solid, Vector3};
use crate::scene::{Obstacle, Scene, Tool};

use super::Plate;

/// The flat end of a tool that goes under an edge: a cuboid from its tip backwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
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

impl Blade {
    /// How far fingers reach beyond the shaft on both sides and along it, metres.
    const FINGERS: f64 = 0.02;

    /// What any hand needs beside the shaft to hold it behind the blade, whose centre is at `pose`: fingers
    /// on both of its sides, no higher than the shaft, as a wrist may come from above or from behind.
    pub fn fingers(&self, pose: &Pose3) -> Solid {
        let mut held = *pose;
        held.position -= pose.rotation * Vector3::x() * (0.5 * self.length + Self::FINGERS);
        Solid::cuboid([2.0 * Self::FINGERS, 2.0 * Self::FINGERS, self.thickness], &held)
    }
}

/// Objects with all their solids, what is fixed around them, and the blade.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverScene {
    /// What can move; a lever names one of them.
    pub plates: Vec<Plate>,
    /// What cannot.
    pub blocks: Vec<Obstacle>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// The lever.
    pub blade: Blade,
}

impl LeverScene {
    /// A scene with a tool's blade in it; a tool without one has an empty one.
    pub fn with(scene: &Scene, tool: &Tool) -> Self {
        Self::new(scene, tool.blade().unwrap_or_default())
    }

    /// A scene with a blade in it.
    pub fn new(scene: &Scene, blade: Blade) -> Self {
        Self {
            plates: scene.objects.iter().map(Plate::of).collect(),
            blocks: scene.obstacles.clone(),
            table_friction: scene.table_friction,
            blade,
        }
    }
}
