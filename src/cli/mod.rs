//! The `pushplan` command: one file per subcommand, each from arguments to a call and its report.
//!
//! Results go to stdout; progress, warnings and errors to stderr. No logic lives here.

mod action;
mod app;
mod bench;
mod check;
mod completions;
mod error;
mod evaluate;
pub mod exit_code;
mod export;
mod fit;
mod follow;
mod form;
mod generate;
#[cfg(feature = "formats")]
mod import;
mod infer;
mod interrupt;
mod lever_argument;
mod model;
mod noise;
mod output;
mod page;
mod poses;
mod predict;
mod push_argument;
mod recordings;
mod regulator;
mod run;
mod schema;
mod session;
mod simulate;
mod solve;
mod tradeoff;
#[cfg(feature = "train")]
mod train;
#[cfg(feature = "train")]
mod train_lever;
#[cfg(feature = "train")]
mod train_regulator;
#[cfg(not(feature = "train"))]
mod untrained;
mod verify;
mod words;

pub use app::run;
