//! A scene in space, as it is levered in.

use serde::{Deserialize, Serialize};

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
