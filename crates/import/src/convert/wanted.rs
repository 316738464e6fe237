//! What is asked for, and the result.

use pushplan::geometry::Vector;

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Names of the bodies that are imported; all that can be, if there are none.
    pub bodies: Vec<String>,
    /// Names of bodies that stand freely although the file holds them.
    pub free: Vec<String>,
    /// Density of bodies that state no mass, kg/m^3.
    pub density: Option<f64>,
    /// What the tool or task is called; by default after the file.
    pub name: Option<String>,
    /// Friction value of bodies that state none.
    pub friction: f64,
    /// How far everything is shifted on the table, metres.
    pub shift: Vector,
}

impl Wanted {
    /// Friction value of bodies that state none: plain wood.
    pub const FRICTION: f64 = pushplan::scene::Scene::FRICTION;

    /// Whether a body is asked for by its name in the file or its name here.
    pub(super) fn takes(&self, name: &str) -> bool {
        self.bodies.is_empty() || self.bodies.iter().any(|body| super::names::same(body, name))
    }
}

impl Default for Wanted {
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            free: Vec::new(),
            density: None,
            name: None,
            friction: Self::FRICTION,
            shift: Vector::zeros(),
        }
    }
}

/// What was imported.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported<T> {
    /// The thing itself.
    pub value: T,
    /// Where it differs slightly from the file, each with its place.
    pub notes: Vec<String>,
}
