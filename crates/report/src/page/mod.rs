//! The plan page: one HTML file that plays a plan, or a run, with everything known about it. It
//! needs no server and no network, and tells the browser to load nothing. On request it contains
//! three.js, which shows the same in 3-D.
//!
//! `data` says what goes into the file, `html` puts it together with the script and the style; the
//! other files fill the data from what there is to show.

mod believed;
mod candidates;
mod data;
mod html;
mod inferred;
mod recipe;
mod replay;
mod replayed;
mod run;
mod solution;
mod space;
mod stage;

pub use html::PageView;
pub use inferred::recording_page;
pub use recipe::{Origin, Recipe, Setting, TaskSource};
pub use replayed::{prediction_page, verdict_page};
pub use run::run_page;
pub use solution::solution_page;
pub use stage::task_stage;
