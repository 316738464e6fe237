//! The reference tool benchmark: choice of tool, pushes and stop that bring a cylinder to a goal,
//! by up to three chained pushes or by a single one.
//!
//! The reference chooses among all chained sequences and stops by prediction only. `sequences` and
//! `choose` implement this protocol on top of an effect model alone, because it measures a model
//! and is not a planner. Other rows show the results of the planner for the same goals and tool
//! poses, through [`pushplan::solve::Planner::solve`].

mod choose;
mod execute;
mod goals;
mod measure;
mod record;
mod sequences;
mod setup;
mod single;
mod spent;
mod summary;
mod trials;

pub use goals::{GoalMade, GoalSet, StartGoals};
pub use measure::{ToolBench, ToolBenchError};
pub use record::{Executed, Method, ToolRecord, ToolTrial};
pub use setup::{Layout, ReferenceSetup, ToolForm};
pub use spent::PROCESSOR;
pub use summary::{EngineErrors, ToolRow, summarise};
