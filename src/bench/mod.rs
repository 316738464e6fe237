//! Measures what the product is for: tool selection in batches, and suites of task files.
//!
//! Everything is seeded, takes any [`crate::effect::EffectModel`] and gives plain data that can
//! be written as JSON; nothing is drawn here.

mod cpu_clock;
mod effects;
mod solved;
mod tools;

pub use cpu_clock::thread_time;
pub use effects::{TimedEffect, timed_effect};
pub use solved::{End, SolvedTask};
pub use tools::{
    EngineErrors, Executed, GoalMade, GoalSet, Layout, Method, PROCESSOR, ReferenceSetup,
    SinglePushes, StartGoals, ToolBench, ToolBenchError, ToolRecord, ToolRow, ToolTrial,
    single_pushes, summarise,
};
