//! `pushplan bench`: what solving brings and costs, one file per benchmark.

mod command;
mod common;
mod convergence;
mod cost;
mod hdd;
mod joints;
mod keep;
mod lever_points;
mod lever_tasks;
mod levers;
mod masses;
mod page;
mod probes;
mod random;
mod refinement;
mod run;
mod saved;
mod status;
mod tasks;
mod tools;

pub use command::{BenchArgs, run};
pub use keep::{value_digest, weights_digest};
