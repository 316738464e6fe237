//! Measurements of lever-ups.

mod accuracy;
mod baselines;
mod convergence;
mod drives;
mod networks;
mod point_search;
mod points;
mod suite;
mod supports;

pub use accuracy::{LeverReport, LeverRow, lever_report};
pub use baselines::{LeverBaseline, Neighbour};
pub use convergence::{ConvergenceReport, ConvergenceRow, Setting, convergence};
pub use drives::{DriveReport, DriveRow, drive_report};
pub use networks::load_lever;
pub use points::{PointReport, PointRow, point_report};
pub use suite::{LeverRecord, LeverSuite};
pub use supports::{SupportRow, support_rows};
