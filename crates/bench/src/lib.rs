//! Measures what the product is for: tool selection in batches, and suites of task files.
//!
//! Everything is seeded, takes any [`pushplan::effect::EffectModel`] and gives plain data that can
//! be written as JSON; nothing is drawn here.
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
    SinglePushes, StartGoals, ToolBench, ToolBenchError, ToolRecord, ToolRow, ToolTrial,
    single_pushes, summarise,
};
