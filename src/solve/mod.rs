//! The planner: search, refine, verify in batches, and the status of the result.
//!
//! [`Planner::solve`] looks at plans of one push, then of two, and so on; of each length it
//! searches, refines the best and has them verified, and it returns the first plan that passes.
//! Not finding one is a [`PlanStatus`], not an error. [`asked_plan`] makes a plan of pushes that a
//! person asks for. [`lever`]
//! does the same for lever-ups.

mod asked;
mod check;
mod efforts;
mod error;
mod grade;
pub mod lever;
mod planner;
mod rank;
mod ranking;
mod reconsider;
mod settings;
mod solution;
mod solving;

pub use asked::{ActionError, Asked, AskedPush, AskedStart, asked_plan};
pub use error::SolveError;
pub use planner::{Planner, PlannerBuilder, Prediction};
pub use settings::{Effort, Settings};
pub use solution::{PlanStatus, RankedPlan, Refinement, Solution, Statistics, Timing};
