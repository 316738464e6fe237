//! A cell of the grid: pushes that have one extreme in common.

use crate::bench::suite::Case;

use super::report::ExtremeKind;

/// Pushes that have one extreme in common.
pub(super) struct Cell {
    /// What is extreme.
    pub factor: &'static str,
    /// How extreme it is.
    pub value: String,
    /// Which ordinary pushes its errors are measured by.
    pub kind: ExtremeKind,
    /// The pushes.
    pub cases: Vec<Case>,
    /// Why the planar engine cannot be trusted here either, where that is known.
    pub doubt: Option<Doubt>,
}

/// Why, and in which pushes, the planar engine is not to be trusted.
#[derive(Clone, Copy)]
pub(super) struct Doubt {
    pub why: &'static str,
    /// Only where an object touches the tool and an obstacle.
    pub crushed: bool,
}

impl Cell {
    pub fn new(
        factor: &'static str,
        value: impl Into<String>,
        kind: ExtremeKind,
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
