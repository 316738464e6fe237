//! What stands on the table.

use serde::{Deserialize, Serialize};

use crate::geometry::{ConvexPolygon, Pose, Shape, Vector};

use super::planar::planar_only;
use super::{
    Feet, Joint, JointKind, Mount, Obstacle, PairFriction, REST_SPEED, Region, State, Support,
    Surface, Whole, pair_friction,
};

/// A movable body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Object {
    /// Unique among objects and obstacles.
    pub name: String,
    /// Its solid.
    pub shape: Shape,
    /// How its weight is spread over its underside.
    #[serde(default)]
    pub support: Support,
    /// Mass, kg.
    pub mass: f64,
    /// Friction value; the coefficient of a pair is the mean of the two values.
    pub friction: f64,
    /// Where it stands at the start.
    pub pose: Pose,
    /// How far a plan may move it, metres; as far as it likes where nothing is said.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub keep: Option<f64>,
    /// Whether it may topple or leave the table.
    #[serde(with = "planar_only", default, skip_serializing_if = "std::ops::Not::not")]
    pub may_fall: bool,
    /// The largest force that may act on it through the tool for longer than an impact, newtons; any by
    /// default.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub max_force: Option<f64>,
    /// Red, green and blue in pictures and other programs, each from 0 to 1; by default that of its role.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub color: Option<[f64; 3]>,
    /// Free height below its edge, metres: what a blade that goes under it has. An object whose
    /// underside is no higher above the table stands on feet of this height at its corners; a
    /// higher one lies on obstacles.
    #[serde(with = "planar_only", default, skip_serializing_if = "is_zero")]
    pub clearance: f64,
    /// Height of its underside at the start, metres: above the table, or of a part above its object's, see
    /// [`Self::is_raised`].
    #[serde(with = "planar_only", default, skip_serializing_if = "is_zero")]
    pub z: f64,
    /// What it is a part of, if it is no thing of its own.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub whole: Option<Whole>,
}

pub(crate) fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl Object {
    /// Default mass of an object, kg: a full can.
    pub const MASS: f64 = 0.4;

    /// Default friction value of an object: wood or plastic.
    pub const FRICTION: f64 = 0.4;

    /// An object at the origin, of mass [`Object::MASS`] and friction value [`Object::FRICTION`].
    ///
    /// ```
    /// use pushplan::Object;
    ///
    /// let can = Object::cylinder("can", 0.05, 0.10).mass(0.35).at(0.62, 0.10, 0.0);
    /// let crate_ = Object::cuboid("crate", [0.3, 0.2, 0.15]).mass(4.0).friction(0.6);
    /// assert_eq!((can.shape.height(), crate_.pose.heading), (0.10, 0.0));
    /// ```
    pub fn new(name: impl Into<String>, shape: Shape) -> Self {
        Self {
            name: name.into(),
            shape,
            support: Support::Even,
            mass: Self::MASS,
            friction: Self::FRICTION,
            pose: Pose::default(),
            keep: None,
            may_fall: false,
            max_force: None,
            color: None,
            clearance: 0.0,
            z: 0.0,
            whole: None,
        }
    }

    /// [`Object::new`] for an upright cylinder, metres.
    pub fn cylinder(name: impl Into<String>, radius: f64, height: f64) -> Self {
        Self::new(name, Shape::Cylinder { radius, height })
    }

    /// [`Object::new`] for a cuboid of these full extents along its x, y and z, metres.
    pub fn cuboid(name: impl Into<String>, size: [f64; 3]) -> Self {
        Self::new(name, Shape::Cuboid { size })
    }

    /// [`Object::new`] for an upright prism of this height, metres.
    ///
    /// ```
    /// use pushplan::{ConvexPolygon, Object, Vector};
    ///
    /// let corners = [[-0.04, -0.03], [0.05, -0.03], [0.0, 0.05]].map(|[x, y]| Vector::new(x, y));
    /// let wedge = Object::prism("wedge", ConvexPolygon::new(&corners)?, 0.06).at(0.5, 0.1, 0.3);
    /// assert_eq!(wedge.shape.height(), 0.06);
    /// # Ok::<(), pushplan::Error>(())
    /// ```
    pub fn prism(name: impl Into<String>, base: ConvexPolygon, height: f64) -> Self {
        Self::new(name, Shape::Prism { base, height })
    }

    /// The object with another mass, kg.
    pub fn mass(self, mass: f64) -> Self {
        Self { mass, ..self }
    }

    /// The object with another friction value.
    pub fn friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// The object with its weight spread in another way than evenly.
    pub fn standing_on(self, support: Support) -> Self {
        Self { support, ..self }
    }

    /// The points under it, with their shares of its weight, that stand for its support.
    pub fn feet(&self) -> Feet {
        self.support.feet(&self.shape.footprint())
    }

    /// The object on feet of this height at its corners, metres, so that a blade fits below its edge.
    pub fn on_feet(self, height: f64) -> Self {
        Self { clearance: height, z: height, ..self }
    }

    /// Whether it is more than an upright solid on the table.
    pub fn in_space(&self) -> bool {
        let above = self.z != 0.0 && !self.is_part();
        above || self.clearance != 0.0
    }

    /// The object with its centre at (`x`, `y`), metres, turned by `heading`, radians.
    pub fn at(self, x: f64, y: f64, heading: f64) -> Self {
        Self { pose: Pose::new(x, y, heading), ..self }
    }
}

/// A table that ends somewhere: a rectangle along the world's axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TableTop {
    /// Full extents along x and y, metres.
    pub size: [f64; 2],
    /// Its middle, metres.
    pub middle: Vector,
}

impl TableTop {
    /// Whether a body with its centre of mass there stays on the table.
    pub fn holds(&self, position: Vector) -> bool {
        let off = position - self.middle;
        2.0 * off.x.abs() <= self.size[0] && 2.0 * off.y.abs() <= self.size[1]
    }
}

/// A table with movable objects, joints between them and fixed obstacles.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Friction value of the table.
    pub table_friction: f64,
    /// Where the table ends; by default nowhere near.
    pub table_top: Option<TableTop>,
    /// How high tools press on objects, where it is known: see [`Physics::push_height`].
    ///
    /// [`Physics::push_height`]: super::Physics::push_height
    pub push_height: Option<f64>,
    /// Movable bodies; indices into this list name them everywhere.
    pub objects: Vec<Object>,
    /// Joints between objects.
    pub joints: Vec<Joint>,
    /// Joints between objects and the world.
    #[serde(with = "planar_only", default, skip_serializing_if = "Vec::is_empty")]
    pub mounts: Vec<Mount>,
    /// Fixed cuboids, on the table or above it.
    pub obstacles: Vec<Obstacle>,
    /// Frictions of pairs that are not the mean of the two values.
    #[serde(default)]
    pub frictions: Vec<PairFriction>,
    /// Regions that are to be kept out of.
    #[serde(with = "planar_only", default, skip_serializing_if = "Vec::is_empty")]
    pub keep_out: Vec<Region>,
}

impl Scene {
    /// Default friction value of the table and of obstacles: plain wood.
    pub const FRICTION: f64 = 0.5;

    /// A table of friction value [`Scene::FRICTION`] with these objects.
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

    /// The scene on a table with another friction value.
    pub fn on_table(self, friction: f64) -> Self {
        Self { table_friction: friction, ..self }
    }

    /// The scene with one more joint.
    pub fn with_joint(mut self, between: [usize; 2], kind: JointKind) -> Self {
        self.joints.push(Joint::new(between, kind));
        self
    }

    /// The scene with one more joint between an object and the world.
    pub fn with_mount(mut self, object: usize, kind: JointKind) -> Self {
        self.mounts.push(Mount { object, kind });
        self
    }

    /// The scene with one more obstacle.
    pub fn with_obstacle(mut self, obstacle: Obstacle) -> Self {
        self.obstacles.push(obstacle);
        self
    }

    /// The scene with this coefficient of friction between an object and another body.
    pub fn with_friction(mut self, object: usize, with: Surface, coefficient: f64) -> Self {
        self.frictions.push(PairFriction { object, with, coefficient });
        self
    }

    /// Whether some object in it is more than an upright solid on the table.
    pub fn in_space(&self) -> bool {
        self.objects.iter().any(Object::in_space)
    }

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
        let mounts = self
            .mounts
            .iter()
            .filter_map(|mount| Some(Mount { object: place(mount.object)?, ..mount.clone() }));
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

    /// The first object whose centre has left the table and may not.
    pub fn off_table(&self, state: &State) -> Option<usize> {
        let top = self.table_top?;
        let off = |k: &usize| !top.holds(self.centre(*k, state)) && !self.objects[*k].may_fall;
        self.things().map(|(k, _)| k).find(off)
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
        let values = [self.objects[index].friction, self.table_friction];
        pair_friction(&self.frictions, index, Surface::Table, values)
    }
}

/// Gravity, m/s^2.
pub const GRAVITY: f64 = 9.81;
