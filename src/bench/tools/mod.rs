//! The reference tool benchmark: which tool, which pushes and where to stop, so that a cylinder
//! ends at a goal.

mod choose;
mod execute;
mod goals;
mod measure;
mod record;
mod setup;
mod single;
mod spent;
mod summary;
mod trials;

pub use goals::{GoalMade, GoalSet, StartGoals};
pub use measure::ToolBench;
pub use record::{Executed, Method, ToolRecord, ToolTrial};
pub use setup::{Layout, ReferenceSetup, ToolPose};
pub use single::{SinglePushes, single_pushes};
pub use spent::PROCESSOR;
pub use summary::{EngineErrors, ToolRow, summarise};
