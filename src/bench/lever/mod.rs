//! What is measured of lever-ups.

mod convergence;
mod suite;

pub use convergence::{ConvergenceReport, ConvergenceRow, Setting, convergence};
pub use suite::{LeverRecord, LeverSuite};
