//! Files that the program writes and reads again: plans and trajectories, in JSON.
//!
//! Each holds the task and the tool in full, in the same keys as the user's own files, so that
//! it can be verified, drawn and evaluated without any other file.

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
