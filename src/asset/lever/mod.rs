//! Files of levering: tasks, and tools with blades. What they may hold, their reading, and the
//! rules that span several keys.

mod blade;
mod build;
mod emit;
mod load;
mod rules;
mod spec;

pub(super) use blade::{BLADE_TOOL, BLADE_TOOL_KEYS, blade_tool_of, is_blade_tool};
pub(super) use emit::{blade_tool, lever_task};
pub use load::{AnyTask, load_any_task};
pub(super) use load::{is_lever_task, lever_task_of, parse_lever_task};
pub(super) use spec::{LEVER_TASK, LEVER_TASK_KEYS};
