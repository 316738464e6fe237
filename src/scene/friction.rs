//! Friction of a pair of bodies.

use serde::{Deserialize, Serialize};

/// The other body of a friction pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Surface {
    /// Another object, by index.
    Object(usize),
    /// An obstacle, by index.
    Obstacle(usize),
    /// The table.
    Table,
    /// Every part of any tool.
    Tool,
}

/// The friction of an object and another body, if it is not the mean of their two values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairFriction {
    /// The object, by index.
    pub object: usize,
    /// The other body.
    pub with: Surface,
    /// Coefficient of friction of the pair.
    pub coefficient: f64,
}

impl PairFriction {
    /// Returns `true` if these two bodies are the pair; the order of two objects does not matter.
    pub fn is_of(&self, object: usize, with: Surface) -> bool {
        let turned = || match with {
            Surface::Object(other) => (other, Surface::Object(object)) == (self.object, self.with),
            _ => false,
        };
        (object, with) == (self.object, self.with) || turned()
    }
}

/// Returns the coefficient of friction of two bodies: the stated coefficient of the pair if there
/// is one, otherwise the mean of the two `values`.
pub fn pair_friction(
    stated: &[PairFriction],
    object: usize,
    with: Surface,
    values: [f64; 2],
) -> f64 {
    let pair = stated.iter().find(|pair| pair.is_of(object, with));
    pair.map_or(0.5 * (values[0] + values[1]), |pair| pair.coefficient)
}
