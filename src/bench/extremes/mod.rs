//! The extremes: one factor at a time far beyond what the weights were trained on, each cell
//! judged against the planar engine and by whether the model warns of it.
//!
//! A model may be wrong out there, but not silently: a cell whose answers are wrong and
//! unflagged, not finite or not bounded is a defect. Beside rollouts stand quadratic programmes
//! and whole tasks with numbers that no sensible file holds. Nothing is mended here.

mod base;
mod cell;
mod crowded;
mod grid;
mod judge;
mod programmes;
mod report;
mod single;
mod tasks;

pub use grid::{ExtremesSettings, extremes};
pub use report::{
    ExtremeCell, ExtremeKind, ExtremeYardstick, ExtremesReport, ProgrammeCell, TaskCell, Verdict,
};
