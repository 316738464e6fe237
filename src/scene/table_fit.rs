//! What recorded pushes taught about one table, as files and plans carry it.

use serde::{Deserialize, Serialize};

use crate::geometry::Shape;

use super::{PairFriction, Scene, Support, Surface};

/// Sizes and masses that differ by less than this share are those of the same object.
const ALIKE: f64 = 0.05;

/// How much of the change of a network counts for objects that it was not learnt on.
///
/// Half: what is true of a table and its pusher carries over and what is true of an object does
/// not, and which is which the recordings of one object cannot tell.
pub const OTHER_OBJECTS: f64 = 0.5;

/// What recordings of one table say: numbers of its physics, and a change of the last layer of
/// the network that predicts it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableFit {
    /// Checksum of the weights of the network that the change is of.
    pub weights: String,
    /// The likeliest change of the network's last layer, [3, 2, h]; zeros where nothing was learnt.
    pub head: Vec<f64>,
    /// What is known of it.
    pub spread: HeadSpread,
    /// Width of what no change explains, metres in x, in y and in the turn at the radius of
    /// gyration, under Student's law with four degrees of freedom.
    pub noise: f64,
    /// Coefficient of friction of tool and objects, where the recordings tell it.
    pub friction: Option<f64>,
    /// Share of the corners' distance at which the objects rest, where the recordings tell it
    /// better than what was stated of them.
    pub support: Option<f64>,
    /// The table's friction, as it was stated.
    pub table_friction: f64,
    /// What it was learnt on.
    pub objects: Vec<FittedObject>,
    /// Number of pushes.
    pub pushes: usize,
}

/// The posterior covariance of a head: the prior's, but narrower along some directions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeadSpread {
    /// The prior's deviation, of every number alike.
    pub prior: f64,
    /// Directions along which recordings narrow it most; they are orthogonal.
    pub directions: Vec<Narrowed>,
}

/// A direction, and how much of the prior's variance is left along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Narrowed {
    /// 0 to 1.
    pub left: f64,
    /// Of length 1.
    pub direction: Vec<f32>,
}

/// An object that was recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FittedObject {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
    /// Its mass as it was stated, kg.
    pub mass: f64,
}

impl HeadSpread {
    /// Deviation of a number that follows the head by `row`.
    pub fn deviation(&self, row: &[f64]) -> f64 {
        let square: f64 = row.iter().map(|value| value * value).sum();
        let known: f64 = self
            .directions
            .iter()
            .map(|Narrowed { left, direction }| {
                let pairs = direction.iter().zip(row);
                let along: f64 = pairs.map(|(a, b)| f64::from(*a) * b).sum();
                (1.0 - left) * along * along
            })
            .sum();
        self.prior * (square - known).max(0.0).sqrt()
    }
}

impl TableFit {
    /// Half the width that holds 90 % of a number which follows the head by `row` and is recorded
    /// with the fit's noise.
    pub fn half_width(&self, row: &[f64]) -> f64 {
        // Of the normal law, and of Student's with four degrees of freedom.
        const NORMAL: f64 = 1.645;
        const STUDENT: f64 = 2.132;
        (NORMAL * self.spread.deviation(row)).hypot(STUDENT * self.noise)
    }

    /// Names of the objects of `scene` that are like none of those it was learnt on.
    pub fn strange<'a>(&self, scene: &'a Scene) -> Vec<&'a str> {
        let objects = scene.objects.iter();
        let strange = objects.filter(|object| {
            !self.objects.iter().any(|known| {
                alike(known.mass, object.mass) && same_shape(&known.shape, &object.shape)
            })
        });
        strange.map(|object| object.name.as_str()).collect()
    }

    /// Lets what is like the objects that it was learnt on rub and rest as the recordings say; the
    /// rest of `scene` stays as it is stated.
    pub fn state(&self, scene: &mut Scene) {
        let strange: Vec<String> = self.strange(scene).into_iter().map(str::to_owned).collect();
        for index in 0..scene.objects.len() {
            if strange.contains(&scene.objects[index].name) {
                continue;
            }
            if let Some(friction) = self.friction {
                scene.frictions.retain(|pair| !pair.is_of(index, Surface::Tool));
                let pair =
                    PairFriction { object: index, with: Surface::Tool, coefficient: friction };
                scene.frictions.push(pair);
            }
            if let Some(support) = self.support {
                scene.objects[index].support = Support::Spread(support);
            }
        }
    }
}

fn alike(a: f64, b: f64) -> bool {
    (a - b).abs() <= ALIKE * a.abs().max(b.abs())
}

/// Whether two shapes are of a kind and of one size.
fn same_shape(a: &Shape, b: &Shape) -> bool {
    let size = |shape: &Shape| {
        let footprint = shape.footprint();
        [shape.height(), footprint.bounding_radius(), footprint.gyration_radius()]
    };
    std::mem::discriminant(a) == std::mem::discriminant(b)
        && size(a).iter().zip(size(b)).all(|(a, b)| alike(*a, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Object, Physics};

    #[test]
    fn the_friction_that_was_fitted_replaces_the_one_that_is_stated() {
        let scene = |mass: f64| {
            let object = Object::cuboid("box", [0.1, 0.1, 0.05]).mass(mass);
            Scene::new([object]).with_friction(0, Surface::Tool, 0.5)
        };
        let known = &scene(0.4).objects[0];
        let fit = TableFit {
            weights: String::new(),
            head: Vec::new(),
            spread: HeadSpread::default(),
            noise: 1e-3,
            friction: Some(0.2),
            support: Some(0.6),
            table_friction: 0.5,
            objects: vec![FittedObject {
                name: "box".into(),
                shape: known.shape,
                mass: known.mass,
            }],
            pushes: 20,
        };
        let told = |mass: f64| {
            let mut scene = scene(mass);
            fit.state(&mut scene);
            let friction = Physics::stated(&scene).friction(0, Surface::Tool, 0.0);
            (friction, scene.objects[0].support.clone())
        };
        assert_eq!(told(0.4), (0.2, Support::Spread(0.6)));
        // Of another object nothing is known.
        assert_eq!(told(4.0), (0.5, Support::Even));
    }

    #[test]
    fn a_direction_that_is_known_narrows_what_follows_it_and_nothing_else() {
        let direction = vec![1.0, 0.0];
        let spread =
            HeadSpread { prior: 2.0, directions: vec![Narrowed { left: 0.25, direction }] };
        assert_eq!(spread.deviation(&[3.0, 0.0]), 3.0);
        assert_eq!(spread.deviation(&[0.0, 3.0]), 6.0);
    }
}
