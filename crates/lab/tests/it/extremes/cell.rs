//! A cell of the grid: pushes that have one extreme in common.

use pushplan_lab::bench::Case;

/// Which ordinary pushes the errors of a cell are measured by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One cylinder.
    Cylinder,
    /// One cuboid.
    Cuboid,
    /// Several objects that touch.
    Several,
    /// Objects in a row, joined.
    Jointed,
}

impl Kind {
    pub const ALL: [Self; 4] = [Self::Cylinder, Self::Cuboid, Self::Several, Self::Jointed];
}

/// Pushes that have one extreme in common.
pub struct Cell {
    /// What is extreme.
    pub factor: &'static str,
    /// How extreme it is.
    pub value: String,
    /// Which ordinary pushes its errors are measured by.
    pub kind: Kind,
    /// The pushes.
    pub cases: Vec<Case>,
    /// Why the planar engine cannot be trusted here either, where that is known.
    pub doubt: Option<Doubt>,
}

/// Why, and in which pushes, the planar engine is not to be trusted.
#[derive(Clone, Copy)]
pub struct Doubt {
    pub why: &'static str,
    /// Only where an object touches the tool and an obstacle.
    pub crushed: bool,
}

impl Cell {
    pub fn new(
        factor: &'static str,
        value: impl Into<String>,
        kind: Kind,
        cases: Vec<Case>,
    ) -> Self {
        Self { factor, value: value.into(), kind, cases, doubt: None }
    }

    /// The same cell with a truth that is not to be trusted.
    pub fn doubted(self, why: &'static str) -> Self {
        Self { doubt: Some(Doubt { why, crushed: false }), ..self }
    }

    /// The same cell with a truth that is not to be trusted where an object touches the tool and
    /// an obstacle.
    pub fn doubted_if_crushed(self, why: &'static str) -> Self {
        Self { doubt: Some(Doubt { why, crushed: true }), ..self }
    }
}
