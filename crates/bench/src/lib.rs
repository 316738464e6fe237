//! Benchmarks of the product: tool selection in batches, and suites of task files.
//!
//! Benchmarks are seeded, accept any [`pushplan::effect::EffectModel`] and return plain data that
//! can be written as JSON. This crate does not draw.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod cpu_clock;
mod effects;
mod solved;
pub mod store;
mod tools;

pub use cpu_clock::thread_time;
pub use effects::{TimedEffect, timed_effect};
pub use solved::{End, SolvedTask};
pub use tools::{
    EngineErrors, Executed, GoalMade, GoalSet, Layout, Method, PROCESSOR, ReferenceSetup,
    StartGoals, ToolBench, ToolBenchError, ToolForm, ToolRecord, ToolRow, ToolTrial, summarise,
};
