//! What stands on the table.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Shape};

use super::{Joint, REST_SPEED, State};

/// A movable body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Object {
    /// Unique among objects and obstacles.
    pub name: String,
    /// Its solid; the whole underside rests on the table with even pressure.
    pub shape: Shape,
    /// Mass, kg.
    pub mass: f64,
    /// Friction value; the coefficient of a pair is the mean of the two values.
    pub friction: f64,
    /// Where it stands at the start.
    pub pose: Pose,
}

/// A cuboid fixed to the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    /// Unique among objects and obstacles.
    pub name: String,
    /// Full extents, metres.
    pub size: [f64; 3],
    /// Where it stands.
    pub pose: Pose,
    /// Friction value.
    pub friction: f64,
}

impl Obstacle {
    /// Its solid.
    pub fn shape(&self) -> Shape {
        Shape::Cuboid { size: self.size }
    }
}

/// A table with movable objects, joints between them and fixed obstacles.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Friction value of the table.
    pub table_friction: f64,
    /// Movable bodies; indices into this list name them everywhere.
    pub objects: Vec<Object>,
    /// Joints between objects.
    pub joints: Vec<Joint>,
    /// Fixed cuboids.
    pub obstacles: Vec<Obstacle>,
}

impl Scene {
    /// Every object at its start, at rest.
    pub fn start(&self) -> State {
        State::at_rest(self.objects.iter().map(|object| object.pose).collect())
    }

    /// Whether every object moves slower than [`REST_SPEED`], at its centre and at its rim.
    pub fn is_resting(&self, state: &State) -> bool {
        self.objects.iter().zip(&state.velocities).all(|(object, velocity)| {
            let rim = velocity.angular.abs() * object.shape.footprint().bounding_radius();
            velocity.linear.norm() < REST_SPEED && rim < REST_SPEED
        })
    }

    /// The scene with these objects alone (indices in order) and the joints among them.
    pub fn only(&self, objects: &[usize]) -> Self {
        let place = |object: usize| objects.iter().position(|&kept| kept == object);
        let joints = self.joints.iter().filter_map(|joint| {
            let [a, b] = joint.between;
            Some(Joint { between: [place(a)?, place(b)?], ..joint.clone() })
        });
        Self {
            objects: objects.iter().map(|&k| self.objects[k].clone()).collect(),
            joints: joints.collect(),
            ..self.clone()
        }
    }

    /// The index of the object called `name`.
    pub fn object(&self, name: &str) -> Option<usize> {
        self.objects.iter().position(|object| object.name == name)
    }

    /// Coefficient of friction of a pair: the mean of the two values.
    pub fn pair_friction(a: f64, b: f64) -> f64 {
        0.5 * (a + b)
    }

    /// Coefficient of friction between object `index` and the table.
    pub fn support_friction(&self, index: usize) -> f64 {
        Self::pair_friction(self.objects[index].friction, self.table_friction)
    }
}

/// Gravity, m/s^2.
pub const GRAVITY: f64 = 9.81;
