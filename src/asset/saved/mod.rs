//! Files that the program writes and reads again: plans and trajectories, in JSON.
//!
//! Each holds the task and the tool in full, in the same keys as the user's own files, so that
//! it can be verified, drawn and evaluated with nothing else at hand.

pub(super) mod emit;
mod lever;
mod lever_spec;
mod plan;
mod read;
mod spec;
mod trajectory;

pub use lever::{AnyPlanFile, LeverPlanFile, LeverTrajectoryFile};
pub use plan::PlanFile;
pub use spec::SCHEMA_VERSION;
pub use trajectory::TrajectoryFile;

pub(super) use lever_spec::{LEVER_PLAN_FILE, LEVER_TRAJECTORY_FILE};
pub(super) use spec::{PLAN_FILE, TRAJECTORY_FILE, VERSION};
