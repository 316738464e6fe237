//! Rules of tools: allowed tools and number of tool changes.

use std::sync::Arc;

use crate::outcome::Warning;
use crate::scene::Tool;
use crate::task::{Plan, Step, Task, ToolChoice};

/// Returns the tool of a step.
pub(super) fn named<'a>(library: &'a [Arc<Tool>], step: &Step) -> Option<&'a Arc<Tool>> {
    library.iter().find(|tool| tool.name == step.tool())
}

/// Returns a warning for each tool that the task does not allow, and for too many tool changes.
pub(super) fn forbidden_tools(task: &Task, plan: &Plan) -> Vec<Warning> {
    let mut found = Vec::new();
    if let ToolChoice::Named(names) = &task.tools {
        let forbidden =
            plan.tools().into_iter().filter(|tool| !names.iter().any(|name| name == tool));
        found.extend(forbidden.map(|tool| Warning::ForbiddenTool { tool: tool.to_owned() }));
    }
    let changes = plan.steps.windows(2).filter(|pair| pair[0].tool() != pair[1].tool()).count();
    let allowed = task.tool_changes();
    if changes > allowed {
        found.push(Warning::TooManyToolChanges { changes, allowed });
    }
    found
}
