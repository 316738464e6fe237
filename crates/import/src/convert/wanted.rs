//! Options and result of an import.

use pushplan::geometry::Vector;

/// Options of an import.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Names of the bodies to import; if empty, all that can be imported.
    pub bodies: Vec<String>,
    /// Names of bodies to detach from the world, so that they stand freely.
    pub free: Vec<String>,
    /// Whether free bodies to which others are jointed are fixed to the world, like a cabinet
    /// against a wall.
    pub fixed: bool,
    /// Density of bodies that state no mass, kg/m^3.
    pub density: Option<f64>,
    /// Name of the tool or task; by default from the file.
    pub name: Option<String>,
    /// Friction value of bodies that state none.
    pub friction: f64,
    /// Translation of everything on the table, metres.
    pub shift: Vector,
}

impl Wanted {
    /// Density of bodies that state no mass if none is given, kg/m^3: MuJoCo's default, water.
    pub const DENSITY: f64 = 1000.0;

    /// Default friction value: plain wood.
    pub const FRICTION: f64 = pushplan::scene::Scene::FRICTION;

    /// Returns `true` if a body is selected, by its name in the file or its name in pushplan.
    pub(super) fn takes(&self, name: &str) -> bool {
        self.bodies.is_empty() || self.bodies.iter().any(|body| super::names::same(body, name))
    }
}

impl Default for Wanted {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            free: Vec::new(),
            fixed: false,
            density: None,
            name: None,
            friction: Self::FRICTION,
            shift: Vector::zeros(),
        }
    }
}

/// Result of an import.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported<T> {
    /// Imported tool or scene.
    pub value: T,
    /// Differences from the file, each with its place, those with a strong effect on motion first.
    pub notes: Vec<String>,
}
