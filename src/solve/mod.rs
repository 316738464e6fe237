//! The planner: search, refine, verify in batches, and the status of the result.
//!
//! [`Planner::solve`] looks at plans of one push, then of two, and so on; of each length it
//! searches, refines the best and has them verified, and it returns the first plan that passes.
//! Not finding one is a [`PlanStatus`], not an error. [`asked_plan`] makes a plan of pushes that a
//! person asks for. Where something leaves the plane, `levering` does the same for lever-ups and for
//! plans that push as well.

mod armed;
mod aside;
mod asked;
mod carry;
mod cause;
mod change;
mod check;
mod design;
mod efforts;
mod error;
mod grade;
mod harden;
mod levering;
mod partly;
mod planner;
mod rank;
mod ranking;
mod reconsider;
mod settings;
mod settle;
mod solution;
mod solving;
mod told;
mod tried;
mod typical;
mod widen;

pub use asked::{ActionError, Asked, AskedPush, AskedStart, asked_plan};
pub use carry::Approach;
pub use cause::Cause;
pub use design::{Design, DesignSettings, Proposal, Spent};
pub use error::SolveError;
pub use levering::{AskedLever, AskedPlace, LeverActionError, LeverSettings, asked_lever};
pub use planner::{Planner, PlannerBuilder, Prediction};
pub use settings::{Effort, Settings};
pub use solution::{
    LeverStatistics, Partial, PlanStatus, RankedPlan, Refinement, Solution, Statistics, Timing,
};
