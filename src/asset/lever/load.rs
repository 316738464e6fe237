//! Telling tasks of levering from those of pushes, and reading them.

use crate::asset::fault::did_you_mean;
use crate::asset::library::ToolLibrary;
use crate::asset::node::Node;
use crate::asset::strict::Ledger;
use crate::task::Task;

use super::{build, rules};

/// Whether the tree is a task of levering rather than one of pushes.
pub(in crate::asset) fn is_lever_task(root: &Node) -> bool {
    let goal = |key| root.get("goal").and_then(|goal| goal.get(key)).is_some();
    root.get("levers").is_some() || ["outside", "raised", "flipped"].into_iter().any(goal)
}

/// Applies the rules that span several keys; `None` if anything needed is missing.
pub(in crate::asset) fn lever_task_of(
    root: &Node,
    file: &str,
    ledger: &mut Ledger,
) -> Option<Task> {
    rules::check(root, ledger);
    build::lever_task(root, file)
}

/// Notes named tools that are not in the library, or of no use.
pub(in crate::asset) fn check_blades(root: &Node, library: &ToolLibrary, ledger: &mut Ledger) {
    rules::blades(root, library, ledger, unknown_blade);
}

/// What to say of a tool that a task of levering names and the library does not have, or has without
/// a blade.
pub(in crate::asset) fn unknown_blade(name: &str, library: &ToolLibrary) -> (String, String) {
    if library.get(name).is_some() {
        let message = format!("`{name}` has no blade, so it cannot lever");
        let known = library.blades().iter().map(|tool| format!("`{}`", tool.name));
        return (message, format!("use {}", known.collect::<Vec<_>>().join(" or ")));
    }
    let known = library.blades().iter().map(|tool| tool.name.as_str());
    (format!("unknown tool `{name}`"), did_you_mean(name, known))
}
