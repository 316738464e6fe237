//! `pushplan-lab evaluate`: errors of effect models on held-out pushes, on crowds, and on the
//! user's own recordings.

mod command;
mod crowds;
mod on;
mod parts;
mod sources;

pub use command::{EvaluateArgs, run};
pub use parts::SUITE;
