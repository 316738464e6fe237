//! `pushplan bench`: tool selection in batches and suites of tasks, one file per benchmark.

pub mod command;
pub mod common;
pub mod keep;
pub mod page;
pub mod saved;
pub mod status;
pub mod suite;
pub mod tasks;
pub mod tools;

pub use command::{BenchArgs, run};
pub use keep::{tools_digest, weights_digest};
