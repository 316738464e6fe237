//! A movable body: an upright solid, alone or as a part of a compound object.

use serde::{Deserialize, Serialize};

use crate::geometry::{ConvexPolygon, Pose, Shape};

use super::serde_planar::{is_zero, planar_only};
use super::{Feet, Support};

/// A movable body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Object {
    /// Name, unique among objects and obstacles.
    pub name: String,
    /// Solid.
    pub shape: Shape,
    /// Distribution of its weight over its underside.
    #[serde(default)]
    pub support: Support,
    /// Mass, kg.
    pub mass: f64,
    /// Friction value; the coefficient of a pair is the mean of the two values.
    pub friction: f64,
    /// Pose at the start.
    pub pose: Pose,
    /// Maximum distance by which a plan may move it, metres; `None` for no limit.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub keep: Option<f64>,
    /// Pose from which [`Self::keep`] counts; `None` for the pose at the start.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub kept_from: Option<Pose>,
    /// Whether it may topple or leave the table.
    #[serde(with = "planar_only", default, skip_serializing_if = "std::ops::Not::not")]
    pub may_fall: bool,
    /// Maximum force that may act on it through the tool for longer than an impact, newtons; `None`
    /// for no limit.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub max_force: Option<f64>,
    /// Red, green and blue in pictures and other programs, each from 0 to 1; `None` for the colour
    /// of its role.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub color: Option<[f64; 3]>,
    /// Free height below its edge, metres, available to a blade. An object whose underside is at
    /// most this high above the table stands on feet of this height at its corners; a higher one
    /// lies on obstacles.
    #[serde(with = "planar_only", default, skip_serializing_if = "is_zero")]
    pub clearance: f64,
    /// Height of its underside at the start, metres: above the table, or, for a part, above the
    /// underside of its object; see [`Self::is_raised`].
    #[serde(with = "planar_only", default, skip_serializing_if = "is_zero")]
    pub z: f64,
    /// The compound object of which it is a part, if any.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub whole: Option<Whole>,
}

impl Object {
    /// Default mass of an object, kg: a full can.
    pub const MASS: f64 = 0.4;

    /// Default friction value of an object: wood or plastic.
    pub const FRICTION: f64 = 0.4;

    /// Creates an object at the origin, of mass [`Object::MASS`] and friction value
    /// [`Object::FRICTION`].
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
            kept_from: None,
            may_fall: false,
            max_force: None,
            color: None,
            clearance: 0.0,
            z: 0.0,
            whole: None,
        }
    }

    /// Calls [`Object::new`] for an upright cylinder, metres.
    pub fn cylinder(name: impl Into<String>, radius: f64, height: f64) -> Self {
        Self::new(name, Shape::Cylinder { radius, height })
    }

    /// Calls [`Object::new`] for a cuboid with these full extents along its x, y and z, metres.
    pub fn cuboid(name: impl Into<String>, size: [f64; 3]) -> Self {
        Self::new(name, Shape::Cuboid { size })
    }

    /// Calls [`Object::new`] for an upright prism of this height, metres.
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

    /// Sets the mass, kg.
    pub fn mass(self, mass: f64) -> Self {
        Self { mass, ..self }
    }

    /// Sets the friction value.
    pub fn friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// Sets the distribution of its weight.
    pub fn standing_on(self, support: Support) -> Self {
        Self { support, ..self }
    }

    /// Returns the points under it that represent its support, with their shares of its weight.
    pub fn feet(&self) -> Feet {
        self.support.feet(&self.shape.footprint())
    }

    /// Puts it on feet of this height at its corners, metres, so that a blade fits below its edge.
    pub fn on_feet(self, height: f64) -> Self {
        Self { clearance: height, z: height, ..self }
    }

    /// Returns `true` if it is more than an upright solid on the table.
    pub fn in_space(&self) -> bool {
        let above = self.z != 0.0 && !self.is_part();
        above || self.clearance != 0.0
    }

    /// Puts its centre at (`x`, `y`), metres, with this `heading`, radians.
    pub fn at(self, x: f64, y: f64, heading: f64) -> Self {
        Self { pose: Pose::new(x, y, heading), ..self }
    }

    /// Returns `true` if it is a part of another object.
    pub fn is_part(&self) -> bool {
        self.whole.is_some()
    }

    /// Puts the underside of a part at this height above the underside of its object, metres.
    ///
    /// ```
    /// use pushplan::{Object, Pose, Scene};
    ///
    /// let pot = Object::cylinder("pot", 0.08, 0.1).mass(0.9);
    /// let handle = Object::cuboid("pot/handle", [0.05, 0.06, 0.02]).mass(0.1).raised(0.06);
    /// let scene = Scene::new([pot]).with_part(0, handle, Pose::new(0.1, 0.0, 0.0));
    /// assert!(scene.objects[1].meets([0.002, 0.07]) && !scene.objects[1].meets([0.002, 0.05]));
    /// ```
    pub fn raised(self, z: f64) -> Self {
        Self { z, ..self }
    }

    /// Returns `true` if it is a part above the table.
    pub fn is_raised(&self) -> bool {
        self.is_part() && self.z > 0.0
    }

    /// Returns its lower and upper height above the table while its object stands there, metres.
    pub fn span(&self) -> [f64; 2] {
        let low = if self.is_raised() { self.z } else { 0.0 };
        [low, low + self.shape.height()]
    }

    /// Returns the height of its top above the table, metres; a body that passes above must be
    /// higher.
    pub fn top(&self) -> f64 {
        self.span()[1]
    }

    /// Returns the height of its middle above the table, metres.
    pub fn middle(&self) -> f64 {
        self.span()[0] + self.shape.height() / 2.0
    }

    /// Returns `true` if it overlaps this range of heights above the table, metres.
    pub fn meets(&self, [low, high]: [f64; 2]) -> bool {
        let [underside, top] = self.span();
        low < top && underside < high
    }
}

/// A link from a part to its compound object.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Whole {
    /// Index of the compound object's first solid in [`Scene::objects`](super::Scene::objects).
    pub object: usize,
    /// Pose of the part in the frame of the first solid.
    pub place: Pose,
}

impl Whole {
    /// Returns the link with another index of the first solid.
    pub(super) fn under(self, object: usize) -> Self {
        Self { object, ..self }
    }
}
