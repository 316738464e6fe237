//! A model fitted to recorded pushes on one table, as files and plans carry it.

use serde::{Deserialize, Serialize};

use crate::geometry::Shape;

use super::{PairFriction, Scene, Support, Surface};

/// Relative difference of sizes and masses below which objects count as the same.
const ALIKE: f64 = 0.05;

/// Factor of the change of a network for objects that are not in its recordings.
///
/// Half: the part of a change that belongs to the table and its pusher carries over, the part that
/// belongs to an object does not. Recordings of one object cannot separate the two.
pub const OTHER_OBJECTS: f64 = 0.5;

/// The result of fitting recordings of one table: physical parameters, and a head of the network.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableFit {
    /// Checksum of the weights of the changed network.
    pub weights: String,
    /// Maximum a posteriori parameters of the network's head, [3, 2, h]; zeros without one.
    pub head: Vec<f64>,
    /// Posterior covariance of the change.
    pub spread: HeadSpread,
    /// Scale of the residual noise in x, in y and in the rotation at the radius of gyration,
    /// metres, under Student's distribution with four degrees of freedom.
    pub noise: f64,
    /// Coefficient of friction of tool and objects, if the recordings determine it.
    pub friction: Option<f64>,
    /// Share of the corners' distance at which the objects rest, if the recordings determine it
    /// better than the stated support.
    pub support: Option<f64>,
    /// Stated friction of the table.
    pub table_friction: f64,
    /// Recorded objects.
    pub objects: Vec<FittedObject>,
    /// Number of recorded pushes.
    pub pushes: usize,
}

/// The posterior covariance of a head: the prior covariance, narrowed along some directions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeadSpread {
    /// Prior standard deviation of every number.
    pub prior: f64,
    /// Directions along which recordings narrow it most, orthogonal to each other.
    pub directions: Vec<Narrowed>,
}

/// A direction and the remaining share of the prior variance along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Narrowed {
    /// Remaining share, 0 to 1.
    pub left: f64,
    /// Unit vector.
    pub direction: Vec<f32>,
}

/// A recorded object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FittedObject {
    /// Name.
    pub name: String,
    /// Shape.
    pub shape: Shape,
    /// Stated mass, kg.
    pub mass: f64,
}

impl HeadSpread {
    /// Returns the standard deviation of a number that depends on the head by `row`.
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
    /// Returns half the width of the 90 % interval of a number that depends on the head by `row`
    /// and is recorded with the fit's noise.
    pub fn half_width(&self, row: &[f64]) -> f64 {
        // Quantiles of the normal distribution, and of Student's with four degrees of freedom.
        const NORMAL: f64 = 1.645;
        const STUDENT: f64 = 2.132;
        (NORMAL * self.spread.deviation(row)).hypot(STUDENT * self.noise)
    }

    /// Returns the names of the objects of `scene` that resemble none of the recorded objects.
    pub fn strange<'a>(&self, scene: &'a Scene) -> Vec<&'a str> {
        let objects = scene.objects.iter();
        let strange = objects.filter(|object| {
            !self.objects.iter().any(|known| {
                alike(known.mass, object.mass) && same_shape(&known.shape, &object.shape)
            })
        });
        strange.map(|object| object.name.as_str()).collect()
    }

    /// Writes the fitted friction and support to objects of `scene` that resemble recorded objects;
    /// other objects keep their stated values.
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

/// Returns `true` if two shapes are of one kind and of about the same size.
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
        let fitted = |mass: f64| {
            let mut scene = scene(mass);
            fit.state(&mut scene);
            let friction = Physics::stated(&scene).friction(0, Surface::Tool, 0.0);
            (friction, scene.objects[0].support.clone())
        };
        assert_eq!(fitted(0.4), (0.2, Support::Spread(0.6)));
        // The fit knows nothing about another object.
        assert_eq!(fitted(4.0), (0.5, Support::Even));
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
