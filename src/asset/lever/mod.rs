//! What files hold of levering beside what every file does: blades, objects in space, lever-ups and
//! goals that speak of lifting; and the rules that span several keys.

mod blade;
mod build;
mod load;
mod rules;
mod spec;

pub(super) use blade::{BLADE_TOOL, BLADE_TOOL_KEYS, blade_tool_of, is_blade_tool};
pub(super) use load::{check_blades, is_lever_task, lever_task_of, unknown_blade};
pub(super) use spec::{LEVER_TASK, LEVER_TASK_KEYS};
