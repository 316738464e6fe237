//! Speed against accuracy: every level of the ladder on the same pushes and the same tasks, in a
//! single run.
//!
//! A run consists of units that are stored one by one (see [`pushplan_bench::store::Store`]):
//!
//! * the errors of a predictor on held-out pushes,
//! * a round of timing all predictors in turn,
//! * a task solved at all levels of planning in turn.
//!
//! Costs are processor time of one thread, so other work on the machine does not count. Compared
//! measurements are close in time. The result is plain data: the measured levels, the levels on the
//! front, and the level chosen for each effort.

mod choice;
mod cost;
mod front;
mod levels;
mod measured;
mod run;

pub use choice::{is_open, prior_instead};
pub use front::{Noise, Point, dominates, on_front};
pub use levels::{Level, PlanLevel, levels, plan_levels};
pub use measured::{ObjectCost, PlanRow, PredictorRow, SuiteErrors, TradeOffReport};
pub use run::{TradeOff, TradeOffSettings, Unit};
