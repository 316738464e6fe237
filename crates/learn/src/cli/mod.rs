//! The command `pushplan-learn`: one file per subcommand.

mod app;
pub mod generate;
mod merge;
mod train;
mod train_lever;
mod train_regulator;
pub mod words;

pub use app::run;
