//! Speed against accuracy: every level of the ladder on the same pushes and the same tasks, in
//! one run.
//!
//! A run is made of units that are kept one by one (see [`pushplan_bench::store::Store`]): the errors of one
//! predictor on held-out pushes; one round of timing all predictors in turn; one task solved at
//! all levels of planning in turn. Costs are processor time of one thread, so other work on the
//! machine does not count, and comparisons are between neighbours in time. What comes out is
//! plain data: the measured levels, those on the front, and the one that each effort stands for.

mod choice;
mod cost;
mod front;
mod levels;
mod measured;
mod run;

pub use choice::{is_open_to, prior_instead};
pub use front::{Noise, Point, dominates, on_front};
pub use levels::{Level, PlanLevel, levels, plan_levels};
pub use measured::{ObjectCost, PlanRow, PredictorRow, SuiteErrors, TradeOffReport};
pub use run::{TradeOff, TradeOffSettings, Unit};
