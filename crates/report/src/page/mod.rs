//! The plan page: one HTML file that plays a plan or a run, and states its models, warnings and
//! verdict.
//!
//! The page needs no server and no network, and its content security policy forbids loading of
//! other files. On request it contains three.js for a 3-D view.
//!
//! `data` defines the content of the file and `html` combines it with the script and the style. The
//! other modules fill the data from their sources.

mod believed;
mod candidates;
mod data;
mod design;
mod html;
mod inferred;
mod recipe;
mod replay;
mod replayed;
mod run;
mod solution;
mod space;
mod stage;
mod units;

pub use design::design_page;
pub use html::PageView;
pub use inferred::recording_page;
pub use recipe::{Origin, Recipe, Setting, TaskSource};
pub use replayed::{plan_stage, prediction_page, verdict_page};
pub use run::run_page;
pub use solution::solution_page;
pub use stage::task_stage;
