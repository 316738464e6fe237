//! Scenes: a table with objects, joints and obstacles.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::geometry::{Vector, wrap_angle};

use super::serde_planar::planar_only;
use super::{
    Fixed, Joint, JointKind, Mover, Object, Obstacle, PairFriction, REST_SPEED, Region, State,
    Surface, WorldJoint, pair_friction,
};

/// A finite table: a rectangle along the world's axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TableTop {
    /// Full extents along x and y, metres.
    pub size: [f64; 2],
    /// Centre, metres.
    pub middle: Vector,
}

impl TableTop {
    /// Returns `true` if a body with its centre of mass at `position` stays on the table.
    pub fn holds(&self, position: Vector) -> bool {
        self.holds_within(position, 0.0)
    }

    /// Returns `true` if a body whose centre of mass is within `error` metres of `position` may
    /// stay on the table.
    pub fn holds_within(&self, position: Vector, error: f64) -> bool {
        let off = position - self.middle;
        2.0 * (off.x.abs() - error) <= self.size[0] && 2.0 * (off.y.abs() - error) <= self.size[1]
    }
}

/// A table with movable objects, joints between them and fixed obstacles.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Friction value of the table.
    pub table_friction: f64,
    /// Extent of the table; `None` for an unlimited one.
    pub table_top: Option<TableTop>,
    /// Height at which tools press on objects, if known: see [`Physics::push_height`].
    ///
    /// [`Physics::push_height`]: super::Physics::push_height
    pub push_height: Option<f64>,
    /// Movable bodies; their indices in this list identify them everywhere.
    pub objects: Vec<Object>,
    /// Joints between objects.
    pub joints: Vec<Joint>,
    /// Joints between objects and the world.
    #[serde(with = "planar_only", default, skip_serializing_if = "Vec::is_empty")]
    pub mounts: Vec<WorldJoint>,
    /// Fixed cuboids, on the table or above it.
    pub obstacles: Vec<Obstacle>,
    /// Frictions of pairs that are not the mean of the two values.
    #[serde(default)]
    pub frictions: Vec<PairFriction>,
    /// Keep-out regions.
    #[serde(with = "planar_only", default, skip_serializing_if = "Vec::is_empty")]
    pub keep_out: Vec<Region>,
}

impl Scene {
    /// Default friction value of the table and of obstacles: plain wood.
    pub const FRICTION: f64 = Obstacle::FRICTION;

    /// Creates a table of friction value [`Scene::FRICTION`] with these objects.
    pub fn new(objects: impl IntoIterator<Item = Object>) -> Self {
        let objects = objects.into_iter().collect();
        Self {
            table_friction: Self::FRICTION,
            table_top: None,
            push_height: None,
            objects,
            joints: Vec::new(),
            mounts: Vec::new(),
            obstacles: Vec::new(),
            frictions: Vec::new(),
            keep_out: Vec::new(),
        }
    }

    /// Sets the friction value of the table.
    pub fn on_table(self, friction: f64) -> Self {
        Self { table_friction: friction, ..self }
    }

    /// Adds a joint.
    pub fn with_joint(mut self, between: [usize; 2], kind: JointKind) -> Self {
        self.joints.push(Joint::new(between, kind));
        self
    }

    /// Adds a joint between an object and the world.
    pub fn with_mount(mut self, object: usize, kind: JointKind) -> Self {
        self.mounts.push(WorldJoint::new(object, kind));
        self
    }

    /// Adds an obstacle.
    pub fn with_obstacle(mut self, obstacle: Obstacle) -> Self {
        self.obstacles.push(obstacle);
        self
    }

    /// Adds a coefficient of friction between an object and another body.
    pub fn with_friction(mut self, object: usize, with: Surface, coefficient: f64) -> Self {
        self.frictions.push(PairFriction { object, with, coefficient });
        self
    }

    /// Returns `true` if some object is more than an upright solid on the table.
    pub fn in_space(&self) -> bool {
        self.objects.iter().any(Object::in_space)
    }

    /// Returns the state at the start: every object at rest.
    pub fn start(&self) -> State {
        State::at_rest(self.objects.iter().map(|object| object.pose).collect())
    }

    /// Returns `true` if every object moves slower than [`REST_SPEED`], at its centre and at its
    /// rim.
    pub fn is_resting(&self, state: &State) -> bool {
        self.objects.iter().zip(&state.velocities).all(|(object, velocity)| {
            let rim = velocity.angular.abs() * object.shape.footprint().bounding_radius();
            velocity.linear.norm() < REST_SPEED && rim < REST_SPEED
        })
    }

    /// Keeps only these objects (indices in order) and the joints between them.
    pub fn only(&self, objects: &[usize]) -> Self {
        let place = |object: usize| objects.iter().position(|&kept| kept == object);
        let joints = self.joints.iter().filter_map(|joint| {
            let [a, b] = joint.between;
            Some(Joint { between: [place(a)?, place(b)?], ..joint.clone() })
        });
        let mounts = self
            .mounts
            .iter()
            .filter_map(|mount| Some(WorldJoint { object: place(mount.object)?, ..mount.clone() }));
        let frictions = self.frictions.iter().filter_map(|pair| {
            let with = match pair.with {
                Surface::Object(other) => Surface::Object(place(other)?),
                other => other,
            };
            Some(PairFriction { object: place(pair.object)?, with, ..*pair })
        });
        let kept = objects.iter().map(|&k| {
            let object = &self.objects[k];
            let whole = object.whole.and_then(|whole| whole.under(place(whole.object)?).into());
            Object { whole, ..object.clone() }
        });
        Self {
            objects: kept.collect(),
            joints: joints.collect(),
            mounts: mounts.collect(),
            frictions: frictions.collect(),
            ..self.clone()
        }
    }

    /// Returns the index of the object called `name`.
    pub fn object(&self, name: &str) -> Option<usize> {
        self.objects.iter().position(|object| object.name == name)
    }

    /// Returns the joint that holds an object, or its compound object, to the world.
    pub fn mount(&self, object: usize) -> Option<&WorldJoint> {
        let thing = self.thing(object);
        self.mounts.iter().find(|mount| mount.object == thing)
    }

    /// Returns the scene in which `keep` counts from the poses in `state`, unless the objects were
    /// [moved](Self::moved_to) before.
    pub fn keeping_from(&self, state: &State) -> Cow<'_, Self> {
        if self.objects.iter().all(|object| object.keep.is_none()) {
            return Cow::Borrowed(self);
        }
        let mut scene = self.clone();
        for (object, pose) in scene.objects.iter_mut().zip(&state.poses) {
            object.kept_from = object.keep.map(|_| object.kept_from.unwrap_or(*pose));
        }
        Cow::Owned(scene)
    }

    /// Moves the objects to their poses in `state` and updates the joints to the world. `keep`
    /// still counts from the poses before.
    pub fn moved_to(&self, state: &State) -> Self {
        let mut scene = self.clone();
        for (object, pose) in scene.objects.iter_mut().zip(&state.poses) {
            object.kept_from = object.keep.map(|_| object.kept_from.unwrap_or(object.pose));
            object.pose = *pose;
        }
        for mount in &mut scene.mounts {
            let WorldJoint { object, .. } = *mount;
            let start = &self.objects[object].pose;
            let mut now = scene.objects[object].pose;
            // Observed headings do not count full turns.
            let middle = mount.kind.middle();
            now.heading = start.heading + middle + wrap_angle(now.heading - start.heading - middle);
            *mount = mount.carried(start, &now);
        }
        scene
    }

    /// Returns the obstacles and regions with which a mover between these heights above the table
    /// must not collide, metres: obstacles at these heights, and keep-out regions for the mover.
    pub fn fixed(&self, mover: Mover, span: [f64; 2]) -> impl Iterator<Item = Fixed<'_>> {
        let obstacles = self.obstacles.iter().filter(move |obstacle| obstacle.meets(span));
        let regions = self.keep_out.iter().filter(move |region| match mover {
            Mover::Tool => region.tool,
            Mover::Hand => region.hand,
        });
        obstacles.map(Fixed::from).chain(regions.map(Fixed::from))
    }

    /// Returns the obstacles entirely above this height, metres, below which nothing is set down
    /// and lifted.
    pub fn above(&self, height: f64) -> impl Iterator<Item = Fixed<'_>> {
        self.obstacles.iter().filter(move |obstacle| obstacle.z >= height).map(Fixed::from)
    }

    /// Returns the coefficient of friction of a pair: the mean of the two values.
    pub fn pair_friction(a: f64, b: f64) -> f64 {
        0.5 * (a + b)
    }

    /// Returns the coefficient of friction between object `index` and the table.
    pub fn support_friction(&self, index: usize) -> f64 {
        let values = [self.objects[index].friction, self.table_friction];
        pair_friction(&self.frictions, index, Surface::Table, values)
    }
}

/// Gravity, m/s^2.
pub const GRAVITY: f64 = 9.81;
