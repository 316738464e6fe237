//! Physical parameters under which a motion is played.

use super::{Scene, Tool};

/// Physical parameters that may differ from those written in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    /// Mass of every object, kg.
    pub masses: Vec<f64>,
    /// Friction value of every object.
    pub frictions: Vec<f64>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// Friction value of the tool.
    pub tool_friction: f64,
}

impl Hypothesis {
    /// The parameters exactly as written in the scene and the tool.
    pub fn nominal(scene: &Scene, tool: &Tool) -> Self {
        Self {
            masses: scene.objects.iter().map(|object| object.mass).collect(),
            frictions: scene.objects.iter().map(|object| object.friction).collect(),
            table_friction: scene.table_friction,
            tool_friction: tool.friction,
        }
    }
}
