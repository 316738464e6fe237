//! What a file of another program says, before it is converted.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Vector3};

use pushplan::asset::Fault;

use super::mesh::Mesh;

/// Where something stands: a line and a column, both counted from one, of a file or of one that it
/// includes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Index into [`Model::files`].
    pub file: usize,
    /// Line.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

/// The bodies of a file.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The name that the file gives it; may be empty.
    pub name: String,
    /// The file and those that it includes, as they are named in faults.
    pub files: Vec<String>,
    /// Bodies, every parent before its children; the first is the world.
    pub bodies: Vec<Body>,
    /// Coefficients of friction of pairs of solids, by their names.
    pub pairs: Vec<([String; 2], f64)>,
    /// What the file has besides bodies that would change pushes, such as actuators.
    pub beyond: Vec<(Place, String)>,
    /// Pairs of bodies that do not touch each other, by their names.
    pub excluded: Vec<(Place, [String; 2])>,
    /// Where objects should end, if the file says so: body, x and y, tolerance (metres) and,
    /// where it matters, heading and its tolerance (radians).
    pub goals: Vec<(String, Vec<f64>)>,
    /// Whether the file was written by `pushplan export`, so that its tool is known.
    pub ours: bool,
    /// How the language makes one coefficient of two.
    pub larger_friction: bool,
}

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name, or what stands for one.
    pub name: String,
    /// Where it stands in the file.
    pub place: Place,
    /// The body that it is attached to; `None` for the world.
    pub parent: Option<usize>,
    /// How it may move against that body.
    pub motion: Motion,
    /// Pose in the world, metres.
    pub pose: Isometry3<f64>,
    /// What it is made of.
    pub solids: Vec<Solid>,
    /// Mass (kg), centre of mass in the world (metres) and, if it says so, moment of inertia about
    /// the vertical through it (kg m^2); none if they follow from the solids.
    pub inertial: Option<(f64, Point3<f64>, Option<f64>)>,
    /// Volume (cubic metres) and centre of volume in the world (metres) of all its solids, where those say
    /// it only roughly.
    pub weighs: Option<(f64, Point3<f64>)>,
    /// What is wrong with it: of importance only to those who want it.
    pub faults: Vec<Fault>,
    /// What is expressed slightly differently, each with its place.
    pub notes: Vec<String>,
}

/// How a body may move against the one that it is attached to.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Nothing.
    Fixed,
    /// Anything.
    Free,
    /// Turn about an axis.
    Hinge {
        /// Unit vector in the world.
        axis: Vector3<f64>,
        /// A point of the axis in the world, metres.
        at: Point3<f64>,
        /// Turns from the start, radians, where limited.
        limits: Option<[f64; 2]>,
    },
    /// Slide along an axis.
    Slide {
        /// Unit vector in the world.
        axis: Vector3<f64>,
        /// Shifts from the start, metres, where limited.
        limits: Option<[f64; 2]>,
    },
    /// All of these.
    Several(Vec<Motion>),
    /// What pushplan cannot express; in words.
    Other(String),
}

/// One solid of a body.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Its name; may be empty.
    pub name: String,
    /// Where it stands in the file.
    pub place: Place,
    /// Its outline.
    pub outline: Outline,
    /// Pose of its middle in the world, metres.
    pub pose: Isometry3<f64>,
    /// What it is made of.
    pub material: Material,
    /// Whether it touches anything; others are only seen.
    pub touches: bool,
}

/// What a solid weighs and how it rubs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// What it weighs.
    pub weight: Weight,
    /// Friction value, if the file has one.
    pub friction: Option<f64>,
    /// Of two solids the one with the higher rank says how they rub.
    pub rank: i64,
    /// Red, green and blue from 0 to 1, if the file has them.
    pub color: Option<[f64; 3]>,
}

impl Material {
    /// The material of a solid whose body states its mass.
    pub fn of_body(friction: Option<f64>) -> Self {
        Self { weight: Weight::OfBody, friction, rank: 0, color: None }
    }
}

/// What a solid weighs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weight {
    /// Kilograms.
    Mass(f64),
    /// Kilograms a cubic metre.
    Density(f64),
    /// Kilograms a square metre of surface.
    Surface(f64),
    /// The body says it.
    OfBody,
}

/// The outline of a solid about its middle, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A box of these half extents.
    Box([f64; 3]),
    /// A cylinder along its z axis.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half of its length.
        half: f64,
    },
    /// A sphere of this radius.
    Sphere(f64),
    /// A capsule along its z axis.
    Capsule {
        /// Radius.
        radius: f64,
        /// Half of its length without the caps.
        half: f64,
    },
    /// An ellipsoid of these half extents.
    Ellipsoid([f64; 3]),
    /// The convex hull of a mesh.
    Mesh(Arc<Mesh>),
    /// The half space below z = 0; half extents x and y of what is drawn, 0 for no end.
    Plane([f64; 2]),
    /// Anything else, in words.
    Other(String),
}

impl Motion {
    /// What a body may do that has this joint and one more.
    pub fn and(self, next: Motion) -> Self {
        match (self, next) {
            (Motion::Fixed, next) => next,
            (Motion::Several(mut all), next) => {
                all.push(next);
                Motion::Several(all)
            }
            (one, next) => Motion::Several(vec![one, next]),
        }
    }

    /// Whether these are two slides along the table and a hinge about the vertical: what stands on it
    /// may do just that.
    pub fn is_planar(&self) -> bool {
        let Motion::Several(all) = self else { return false };
        let slides = all.iter().filter_map(|motion| match motion {
            Motion::Slide { axis, .. } if axis.z.abs() < 1e-3 => Some(axis),
            _ => None,
        });
        let slides: Vec<_> = slides.collect();
        let turns = |motion: &Motion| matches!(motion, Motion::Hinge { axis, .. } if axis.xy().norm() < 1e-3);
        let rises = |motion: &Motion| matches!(motion, Motion::Slide { axis, .. } if axis.xy().norm() < 1e-3);
        let is = |motion: &Motion| {
            turns(motion)
                || rises(motion)
                || matches!(motion, Motion::Slide { axis, .. } if axis.z.abs() < 1e-3)
        };
        slides.len() == 2
            && slides[0].cross(slides[1]).norm() > 0.1
            && all.iter().any(turns)
            && all.iter().all(is)
    }
}

impl Body {
    /// What the world is called.
    pub const WORLD: &str = "world";

    /// The world, with nothing in it.
    pub fn world() -> Self {
        Self {
            name: Self::WORLD.to_owned(),
            place: Place { line: 1, column: 1, file: 0 },
            parent: None,
            motion: Motion::Fixed,
            pose: Isometry3::identity(),
            solids: Vec::new(),
            inertial: None,
            weighs: None,
            faults: Vec::new(),
            notes: Vec::new(),
        }
    }
}

impl Model {
    /// The body that `pushplan export` makes the tool.
    pub const TOOL: &str = "tool";

    /// A body's name; the world's is `world`.
    pub fn name_of(&self, body: usize) -> &str {
        self.bodies.get(body).map_or("", |body| &body.name)
    }

    /// The bodies attached to `body`, in order.
    pub fn children(&self, body: usize) -> impl Iterator<Item = usize> + '_ {
        let hangs = move |index: &usize| self.bodies[*index].parent == Some(body);
        (0..self.bodies.len()).filter(hangs)
    }

    /// Whether a body, or the one that it is attached to, is a part of the world.
    pub fn is_fixed(&self, body: Option<usize>) -> bool {
        body.is_some_and(|body| {
            body == 0
                || self.bodies[body].motion == Motion::Fixed
                    && self.is_fixed(self.bodies[body].parent)
        })
    }

    /// `body` and everything that hangs on it, in order.
    pub fn below(&self, body: usize) -> Vec<usize> {
        let mut found = vec![body];
        for index in body + 1..self.bodies.len() {
            if self.bodies[index].parent.is_some_and(|parent| found.contains(&parent)) {
                found.push(index);
            }
        }
        found
    }

    /// `body` and everything that is fixed to it, in order.
    pub fn rigid(&self, body: usize) -> Vec<usize> {
        let mut group = vec![body];
        // Parents stand before their children.
        for index in body + 1..self.bodies.len() {
            let Body { parent, motion, .. } = &self.bodies[index];
            if *motion == Motion::Fixed && parent.is_some_and(|parent| group.contains(&parent)) {
                group.push(index);
            }
        }
        group
    }
}
