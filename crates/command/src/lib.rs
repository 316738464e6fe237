//! The `pushplan` command: one file per subcommand, which converts arguments to a call and a
//! report.
//!
//! Results go to stdout; progress, warnings and errors to stderr. The planning logic is in the
//! other crates.
#![deny(unsafe_code)]

pub mod action;
pub mod app;
pub mod bench;
pub mod check;
pub mod completions;
pub mod design;
pub mod error;
pub mod exit_code;
pub mod export;
pub mod fit;
pub mod form;
pub mod groups;
pub mod import;
pub mod infer;
pub mod interrupt;
pub mod lever_argument;
pub mod mcp;
pub mod model;
pub mod new;
pub mod noise;
pub mod output;
pub mod page;
pub mod poses;
pub mod predict;
pub mod progress;
pub mod push_argument;
pub mod recorded;
pub mod recordings;
pub mod regulator;
pub mod run;
mod schema;
pub mod session;
pub mod solve;
pub mod task_argument;
pub mod value_enums;
pub mod verify;

pub use app::{command, run, start};
