//! Command `pushplan-learn`: one file per subcommand.

mod app;
mod compare;
pub mod generate;
mod merge;
pub mod train;
pub mod value_enums;

pub use app::run;
