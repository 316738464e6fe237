//! The planner of lever-ups: search, coarse simulation of the best, verification in batches; and where
//! that does not do, of pushes that follow.

mod asked;
mod check;
mod doubt;
mod follow_up;
mod planner;
mod settings;
mod solution;

pub use asked::{AskedLever, AskedLeverPlan, AskedPlace, LeverActionError, asked_lever};
pub use planner::LeverPlanner;
pub use settings::LeverSettings;
pub use solution::{LeverSolution, LeverStatistics, LeverTiming, PushedAfter, RankedLever};
