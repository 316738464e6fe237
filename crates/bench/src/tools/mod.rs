//! The reference tool benchmark: which tool, which pushes and where to stop, so that a cylinder
//! ends at a goal.
//!
//! The reference chooses among all chained sequences and stops by prediction alone; that protocol
//! stands in `sequences` and `choose` on nothing but an effect model, because it measures a model
//! and is not a way to plan. Other rows show what the planner makes of the same goals with the same
//! tool poses, through [`pushplan::solve::Planner::solve`].

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
pub use setup::{Layout, ReferenceSetup};
pub use single::{SinglePushes, single_pushes};
pub use spent::PROCESSOR;
pub use summary::{EngineErrors, ToolRow, summarise};
