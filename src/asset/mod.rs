//! Reading and writing of user files: tools, tasks, plans, trajectories, recordings.
//!
//! Reading is strict: all faults of a file are reported at once, with source positions. This is the
//! only module that names the YAML crate. A file is read in three steps. Its text becomes a tree of
//! nodes with places (`node`, `reader`). The tree is checked against the specification of the file
//! (`spec`, `strict`). Rules that span several keys are applied while the domain type is built
//! (`tool`, `task`, `saved`). Nothing is simulated or drawn here.

mod arm;
mod blade;
mod diagnostic;
mod example;
mod field;
mod folder;
mod kind;
mod library;
mod node;
mod printable;
mod put;
mod reader;
mod recording;
mod saved;
mod schema;
mod shapes;
mod spec;
mod strict;
mod table_fit;
mod take;
mod task;
mod text;
mod tool;
mod world;
mod write;

pub use diagnostic::{Fault, Faults, Place};
pub use example::{example_text, load_example};
pub use folder::recordings_in;
pub use kind::{Kind, check};
pub use library::ToolLibrary;
pub use node::{Content, Node};
pub use printable::printable;
pub use reader::locate;
pub use recording::RECORDING_FORMAT;
pub use saved::{PLAN_VERSION, PlanFile, SCHEMA_VERSION, TrajectoryFile};
pub use schema::{
    plan_schema, recording_schema, task_schema, tool_schema, trajectory_schema, world_schema,
};
pub use task::{load_task, parse_task};
pub use text::{Source, is_in_names, named_after, read_text};
pub use tool::MAX_PARTS;
pub use world::load_world;
pub use write::write_atomic;
