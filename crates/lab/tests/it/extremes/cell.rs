//! A cell of the grid: pushes that share an extreme.

use pushplan_lab::bench::Case;

/// Kind of ordinary pushes that the errors of a cell are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A cylinder.
    Cylinder,
    /// A cuboid.
    Cuboid,
    /// Several objects that touch.
    Several,
    /// Objects in a row, joined.
    Jointed,
}

impl Kind {
    pub const ALL: [Self; 4] = [Self::Cylinder, Self::Cuboid, Self::Several, Self::Jointed];
}

/// Pushes that share an extreme.
pub struct Cell {
    /// Name of the extreme factor.
    pub factor: &'static str,
    /// Value of the factor.
    pub value: String,
    /// Kind of ordinary pushes that its errors are compared with.
    pub kind: Kind,
    /// The pushes.
    pub cases: Vec<Case>,
    /// Reason for which the 2-D engine cannot be trusted either, if known.
    pub doubt: Option<Doubt>,
}

/// Reason and condition of distrust in the 2-D engine.
#[derive(Clone, Copy)]
pub struct Doubt {
    pub why: &'static str,
    /// Whether only pushes in which an object touches the tool and an obstacle are affected.
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

    /// Returns the cell with an untrusted ground truth.
    pub fn doubted(self, why: &'static str) -> Self {
        Self { doubt: Some(Doubt { why, crushed: false }), ..self }
    }

    /// Returns the cell with a ground truth that is untrusted where an object touches the tool and
    /// an obstacle.
    pub fn doubted_if_crushed(self, why: &'static str) -> Self {
        Self { doubt: Some(Doubt { why, crushed: true }), ..self }
    }
}
