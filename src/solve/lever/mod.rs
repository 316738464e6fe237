//! The planner of lever-ups: search, coarse simulation of the best, verification in batches.

mod asked;
mod check;
mod doubt;
mod planner;
mod settings;
mod solution;

pub use asked::{AskedLever, AskedLeverPlan, AskedPlace, LeverActionError, asked_lever};
pub use planner::LeverPlanner;
pub use settings::LeverSettings;
pub use solution::{LeverSolution, LeverStatistics, LeverTiming, RankedLever};
