//! The planner: search, refine, verify in batches, and the status of the result.
//!
//! [`Planner::solve`] looks at plans of one push, then of two, and so on; of each length it
//! searches, refines the best and has them verified, and it returns the first plan that passes.
//! Not finding one is a [`PlanStatus`], not an error. [`manual_plan`] makes a plan of pushes that a
//! person asks for. Where something leaves the plane, `levering` does the same for lever-ups and for
//! plans that push as well.

mod adaptive_verify;
mod arm_feasibility;
mod attempts;
mod check;
mod clearing;
mod efforts;
mod error;
mod grade;
mod harden;
mod infeasibility;
mod levering;
mod manual_plan;
mod partial_goals;
mod planner;
mod progress;
mod rank;
mod ranking;
mod relaxation;
mod retry;
mod settings;
mod solution;
mod solving;
mod tool_change;
mod transport;
mod typical;

pub use error::SolveError;
pub use infeasibility::Cause;
pub use levering::{LeverActionError, LeverSettings, ManualLever, ManualPlace, manual_lever};
pub use manual_plan::{ActionError, ManualPlan, ManualPush, ManualStart, manual_plan};
pub use planner::{Planner, PlannerBuilder, Prediction};
pub use settings::{Effort, Settings};
pub use solution::{
    LeverStatistics, Partial, PlanStatus, RankedPlan, Refinement, Solution, Statistics, Timing,
};
pub use transport::Approach;

pub(crate) use grade::{Class, Grade, WELL_INSIDE};
pub(crate) use planner::stated;
pub(crate) use rank::distinct;
