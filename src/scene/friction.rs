//! Friction of a pair of bodies.

use serde::{Deserialize, Serialize};

use super::{Physics, Scene};

/// What rubs on an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Surface {
    /// Another object, by index.
    Object(usize),
    /// An obstacle, by index.
    Obstacle(usize),
    /// The table.
    Table,
    /// Every part of whatever tool.
    Tool,
}

/// The friction of an object and another body, where it is not the mean of their two values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairFriction {
    /// The object, by index.
    pub object: usize,
    /// What rubs on it.
    pub with: Surface,
    /// Their coefficient of friction.
    pub coefficient: f64,
}

impl PairFriction {
    /// Whether these two are the pair; two objects are it either way round.
    pub fn is_of(&self, object: usize, with: Surface) -> bool {
        let turned = || match with {
            Surface::Object(other) => (other, Surface::Object(object)) == (self.object, self.with),
            _ => false,
        };
        (object, with) == (self.object, self.with) || turned()
    }
}

/// The coefficient of friction of two bodies: what is stated of the pair, or else the mean of the
/// two `values`.
pub fn pair_friction(
    stated: &[PairFriction],
    object: usize,
    with: Surface,
    values: [f64; 2],
) -> f64 {
    let pair = stated.iter().find(|pair| pair.is_of(object, with));
    pair.map_or(Scene::pair_friction(values[0], values[1]), |pair| pair.coefficient)
}

impl Physics {
    /// Coefficient of friction between an object and a body of this friction `value`.
    pub fn friction(&self, object: usize, with: Surface, value: f64) -> f64 {
        pair_friction(&self.pairs, object, with, [self.frictions[object], value])
    }

    /// The same with this coefficient of friction between an object and another body.
    pub fn with_pair(mut self, object: usize, with: Surface, coefficient: f64) -> Self {
        self.pairs.retain(|pair| !pair.is_of(object, with));
        self.pairs.push(PairFriction { object, with, coefficient });
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Object;

    #[test]
    fn what_is_stated_of_a_pair_counts_either_way_round_and_for_that_pair_alone() {
        let object = |name: &str| Object::cylinder(name, 0.05, 0.1).friction(0.4);
        let scene = Scene::new([object("a"), object("b"), object("c")]).on_table(0.6);
        let physics = Physics::stated(&scene).with_pair(0, Surface::Object(1), 0.02).with_pair(
            2,
            Surface::Table,
            0.3,
        );
        assert_eq!(physics.friction(0, Surface::Object(1), 0.4), 0.02);
        assert_eq!(physics.friction(1, Surface::Object(0), 0.4), 0.02);
        assert_eq!(physics.friction(0, Surface::Object(2), 0.4), 0.4);
        assert_eq!(physics.friction(1, Surface::Tool, 0.2), 0.5 * (0.4 + 0.2));
        assert_eq!((physics.support_friction(1), physics.support_friction(2)), (0.5, 0.3));
        let again = physics.with_pair(1, Surface::Object(0), 0.1);
        assert_eq!((again.pairs.len(), again.friction(0, Surface::Object(1), 0.4)), (2, 0.1));
    }
}
