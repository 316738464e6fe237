//! What is measured of lever-ups.

mod convergence;

pub use convergence::{ConvergenceReport, ConvergenceRow, Setting, convergence};
