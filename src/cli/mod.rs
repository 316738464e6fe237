//! The `pushplan` command: one file per subcommand, each from arguments to a call and its report.
//!
//! Results go to stdout; progress, warnings and errors to stderr. No logic lives here.

#![allow(dead_code)] // Until the commands that plan and train are here.

mod action;
mod app;
mod check;
mod completions;
mod error;
pub mod exit_code;
mod interrupt;
mod model;
mod output;
mod predict;
mod push_argument;
mod schema;
mod session;
mod simulate;
mod solve;
mod verify;

pub use app::run;
