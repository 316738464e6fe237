//! Planner: strategies that share one blackboard, and the status of the result.
//!
//! [`Planner::solve`] asks strategies in the order that `strategy` states. The first one with a
//! next step proposes a batch of plans. The loop refines, verifies and grades the batch, and stores
//! the plans as attempts on the blackboard. It ends when no strategy has a next step. A missing
//! plan is a [`PlanStatus`] and not an error. [`manual_plan`] returns a plan of pushes specified by
//! a user, and [`manual_lever`] a plan of a lever-up.

mod adaptive_verify;
mod aims;
mod all_budgets;
mod arm_feasibility;
mod attempts;
mod blackboard;
mod candidates;
mod check;
mod choice;
mod efforts;
mod entry_points;
mod error;
mod grade;
mod infeasibility;
mod lever_batch;
mod lever_check;
mod lever_settings;
mod manual_lever;
mod manual_plan;
mod partial_goals;
mod pattern;
mod planner;
mod progress;
mod query;
mod rank;
mod refinement;
mod refiner;
mod report;
mod retry;
mod settings;
mod solution;
mod solving;
mod strategy;
mod try_out;
mod typical;

pub use error::{SolveError, TaskFault};
pub use infeasibility::Cause;
pub use lever_settings::LeverSettings;
pub use manual_lever::{LeverActionError, ManualLever, ManualPlace, manual_lever};
pub use manual_plan::{ActionError, ManualPlan, ManualPush, ManualStart, manual_plan};
pub use planner::{Planner, PlannerBuilder, Prediction};
pub use settings::{Effort, Settings};
pub use solution::{
    LeverStatistics, Partial, PlanStatus, RankedPlan, Refinement, Solution, Statistics, Timing,
};
pub use strategy::Approach;

pub use grade::{Class, Grade, WELL_INSIDE};
pub use planner::stated;
pub use rank::distinct;
