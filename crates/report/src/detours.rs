//! Detours of the tool between pushes.

use std::sync::Arc;

use pushplan::{
    scene::Tool,
    task::{Plan, PushStep, Task, TravelPath},
};

use super::plan_text::point;

/// Returns a line for each detour between two pushes.
pub(super) fn detours(task: &Task, plan: &Plan, tools: &[Arc<Tool>]) -> Vec<String> {
    let Some(tool) = tools.first().filter(|_| !plan.levers()) else { return Vec::new() };
    let pushes: Vec<_> = plan.push_steps().collect();
    let around = |(k, pair): (usize, &[&PushStep])| {
        let TravelPath::Around { what, by } =
            task.path_between(&task.scene, tool, [pair[0], pair[1]])?
        else {
            return None;
        };
        let by: Vec<String> = by.into_iter().map(point).collect();
        let (height, by) = (task.robot.travel, by.join(", "));
        let (from, to) = (k + 1, k + 2);
        Some(format!(
            "between pushes {from} and {to} the tool moves {height:.2} m above the table around \
             {what}, via {by}"
        ))
    };
    pushes.windows(2).enumerate().filter_map(around).collect()
}
