//! Intermediate model of a file of another program, before conversion.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Vector3};

use pushplan::asset::Fault;

use super::diagnostic::Note;
use super::mesh::Mesh;

/// Position in a file or an included file: line and column, both counted from one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Index into [`Model::files`].
    pub file: usize,
    /// Line number.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

/// Bodies of a file.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Name stated in the file; may be empty.
    pub name: String,
    /// Names of the file and of included files, as used in faults.
    pub files: Vec<String>,
    /// Bodies, every parent before its children; the first is the world.
    pub bodies: Vec<Body>,
    /// Friction coefficients of pairs of solids, by their names.
    pub pairs: Vec<([String; 2], f64)>,
    /// Elements other than bodies that would change pushes, such as actuators.
    pub beyond: Vec<Beyond>,
    /// Names of joints, with the indices of their bodies.
    pub joints: Vec<(String, usize)>,
    /// Notes on the file as a whole.
    pub notes: Vec<Note>,
    /// Whether the bodies are the separate pieces of one mesh file.
    pub pieces: bool,
    /// Pairs of bodies that do not collide, by their names.
    pub excluded: Vec<(Place, [String; 2])>,
    /// Goals of bodies, if stated: body, x and y, tolerance (metres) and, optionally, heading and
    /// its tolerance (radians).
    pub goals: Vec<(String, Vec<f64>)>,
    /// Whether the file was written by `pushplan export`, so that its tool is known.
    pub ours: bool,
    /// Whether the larger of two friction values applies to a pair.
    pub larger_friction: bool,
    /// Whether missing data of the file are faults instead of assumptions.
    pub strict: bool,
}

/// Element other than a body that would change pushes.
#[derive(Clone, Debug)]
pub struct Beyond {
    /// Position in the file.
    pub place: Place,
    /// Description, such as `<tendon>`.
    pub what: String,
    /// Indices of the bodies that it acts on, if known.
    pub bodies: Option<Vec<usize>>,
}

/// Rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name, or a substitute.
    pub name: String,
    /// Position in the file.
    pub place: Place,
    /// Index of the parent body; `None` for the world.
    pub parent: Option<usize>,
    /// Motion relative to the parent body.
    pub motion: Motion,
    /// Pose in the world, metres.
    pub pose: Isometry3<f64>,
    /// Solids of the body.
    pub solids: Vec<Solid>,
    /// Mass (kg), centre of mass in the world (metres) and, if stated, moment of inertia about the
    /// vertical through it (kg m^2). `None` if they follow from the solids.
    pub inertial: Option<(f64, Point3<f64>, Option<f64>)>,
    /// Volume (cubic metres) and centroid in the world (metres) of all solids, if the solids only
    /// approximate them.
    pub weighs: Option<(f64, Point3<f64>)>,
    /// Surface in the world that the solids approximate, if they do.
    pub surface: Option<Arc<Mesh>>,
    /// Faults of the body, reported only if it is imported.
    pub faults: Vec<Fault>,
    /// Notes on differences from the file.
    pub notes: Vec<Note>,
}

/// Motion of a body relative to its parent.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Rigid connection.
    Fixed,
    /// Free motion.
    Free,
    /// Rotation about an axis.
    Hinge {
        /// Unit vector in the world.
        axis: Vector3<f64>,
        /// Point on the axis in the world, metres.
        at: Point3<f64>,
        /// Limits of the rotation from the start, radians, if any.
        limits: Option<[f64; 2]>,
    },
    /// Translation along an axis.
    Slide {
        /// Unit vector in the world.
        axis: Vector3<f64>,
        /// Limits of the translation from the start, metres, if any.
        limits: Option<[f64; 2]>,
    },
    /// Combination of several joints.
    Several(Vec<Motion>),
    /// Motion that pushplan cannot express, in words.
    Other(String),
}

/// Solid of a body.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Name; may be empty.
    pub name: String,
    /// Position in the file.
    pub place: Place,
    /// Outline.
    pub outline: Outline,
    /// Pose of the middle in the world, metres.
    pub pose: Isometry3<f64>,
    /// Mass, friction and colour.
    pub material: Material,
    /// Whether the solid collides; other solids are visual only.
    pub touches: bool,
}

/// Mass, friction and colour of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Mass of the solid.
    pub weight: Weight,
    /// Friction value, if stated.
    pub friction: Option<f64>,
    /// Priority of the friction value: of two solids, the one with the higher rank determines the
    /// friction.
    pub rank: i64,
    /// Red, green and blue from 0 to 1, if stated.
    pub color: Option<[f64; 3]>,
}

impl Material {
    /// Creates the material of a solid whose body states the mass.
    pub fn of_body(friction: Option<f64>) -> Self {
        Self { weight: Weight::OfBody, friction, rank: 0, color: None }
    }
}

/// Mass of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weight {
    /// Mass, kg.
    Mass(f64),
    /// Density, kg/m^3.
    Density(f64),
    /// Mass per surface area, kg/m^2.
    Surface(f64),
    /// Mass stated by the body.
    OfBody,
}

/// Outline of a solid about its middle, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// Box with these half extents.
    Box([f64; 3]),
    /// Cylinder along its z axis.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half of the length.
        half: f64,
    },
    /// Sphere with this radius.
    Sphere(f64),
    /// Capsule along its z axis.
    Capsule {
        /// Radius.
        radius: f64,
        /// Half of the length without the caps.
        half: f64,
    },
    /// Ellipsoid with these semi-axes.
    Ellipsoid([f64; 3]),
    /// Convex hull of a mesh.
    Mesh(Arc<Mesh>),
    /// Half space below z = 0, with half extents x and y of its drawing; 0 means unlimited.
    Plane([f64; 2]),
    /// Other outline, in words.
    Other(String),
}

impl Motion {
    /// Combines this motion with the motion of a further joint.
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

    /// Returns `true` for two translations along the table and a rotation about the vertical, the
    /// motion of an object that stands on it.
    pub fn is_planar(&self) -> bool {
        let Motion::Several(all) = self else { return false };
        let slides = all.iter().filter_map(|motion| match motion {
            Motion::Slide { axis, .. } if axis.z.abs() < 1e-3 => Some(axis),
            _ => None,
        });
        let slides: Vec<_> = slides.collect();
        let turns = |motion: &Motion| match motion {
            Motion::Hinge { axis, .. } => axis.xy().norm() < 1e-3,
            _ => false,
        };
        let rises = |motion: &Motion| match motion {
            Motion::Slide { axis, .. } => axis.xy().norm() < 1e-3,
            _ => false,
        };
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
    /// Name of the world.
    pub const WORLD: &str = "world";

    /// Creates an empty world.
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
            surface: None,
            faults: Vec::new(),
            notes: Vec::new(),
        }
    }
}

impl Model {
    /// Name of the tool's body in files of `pushplan export`.
    pub const TOOL: &str = "tool";

    /// Returns the body of the joint with this name.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().find(|(joint, _)| joint == name).map(|(_, body)| *body)
    }

    /// Returns a body's name; the name of the world is `world`.
    pub fn name_of(&self, body: usize) -> &str {
        self.bodies.get(body).map_or("", |body| &body.name)
    }

    /// Returns the bodies attached to `body`, in order.
    pub fn children(&self, body: usize) -> impl Iterator<Item = usize> + '_ {
        let hangs = move |index: &usize| self.bodies[*index].parent == Some(body);
        (0..self.bodies.len()).filter(hangs)
    }

    /// Returns `true` if a body is the world or fixed to it, directly or through other bodies.
    pub fn is_fixed(&self, body: Option<usize>) -> bool {
        body.is_some_and(|body| {
            body == 0
                || self.bodies[body].motion == Motion::Fixed
                    && self.is_fixed(self.bodies[body].parent)
        })
    }

    /// Returns `body` and all its descendants, in order.
    pub fn below(&self, body: usize) -> Vec<usize> {
        let mut found = vec![body];
        for index in body + 1..self.bodies.len() {
            if self.bodies[index].parent.is_some_and(|parent| found.contains(&parent)) {
                found.push(index);
            }
        }
        found
    }

    /// Returns `body` and everything fixed to it, in order.
    pub fn rigid(&self, body: usize) -> Vec<usize> {
        let mut group = vec![body];
        // Parents precede their children.
        for index in body + 1..self.bodies.len() {
            let Body { parent, motion, .. } = &self.bodies[index];
            if *motion == Motion::Fixed && parent.is_some_and(|parent| group.contains(&parent)) {
                group.push(index);
            }
        }
        group
    }
}
