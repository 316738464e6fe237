//! Plan and trajectory files, which the program writes and reads back, in JSON.
//!
//! Each file holds the complete task and tools, with the keys of the user's own files. It can
//! therefore be verified, drawn and evaluated without any other file.

pub(super) mod emit;
mod plan;
mod read;
mod spec;
mod steps;
pub(super) mod things;
mod trajectory;
mod verdict;

pub use plan::PlanFile;
pub use spec::{PLAN_VERSION, SCHEMA_VERSION};
pub use trajectory::TrajectoryFile;

pub(super) use spec::{PLAN_FILE, TRAJECTORY_FILE, version};
