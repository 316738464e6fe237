//! The `pushplan` command: one file per subcommand, each from arguments to a call and its report.
//!
//! Results go to stdout; progress, warnings and errors to stderr. No logic lives here.

#![allow(dead_code)] // Until the commands that plan and train are here.

mod app;
mod completions;
mod error;
pub mod exit_code;
mod interrupt;
mod schema;
mod session;

pub use app::run;
