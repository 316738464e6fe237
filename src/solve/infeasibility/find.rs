//! Search for the cause: relaxations in the order in which users prefer to change their task.

use crate::asset::ToolLibrary;
use crate::progress::{Progress, Quiet};
use crate::solve::planner::{Planner, stated};
use crate::task::{Task, ToolChoice};

use super::beyond::{beyond, out_of_reach};
use super::enclosed::enclosed;
use super::limits::limits;
use super::obstructed::obstructed;
use super::relaxed::{Case, Relaxed};
use super::{Cause, Hints};

/// Returns the cause that prevents a plan for `task`, or `None` if `progress` stops the search.
/// The budgets belong to a coarse search, and plans are replayed as written only.
pub(in crate::solve) fn cause(
    planner: &Planner,
    task: &Task,
    library: &ToolLibrary,
    hints: &Hints,
    progress: &dyn Progress,
) -> Option<Cause> {
    let tools = task.tools(library).ok()?;
    let situation = stated(task);
    // A longer tool may exist that the task does not name.
    let all = Task { tools: ToolChoice::All, ..task.clone() }.tools(library).ok()?;
    let at_once = || out_of_reach(task, &situation, &all);
    if let Some(cause) = at_once().or_else(|| beyond(task, &situation, &all)) {
        return Some(cause);
    }
    let planner = &planner.first_look();
    let progress = &Quiet(progress);
    let case = Case { planner, task, tools: &tools, library, hints, progress };
    let walls = enclosed(task);
    let relaxed = |one: Relaxed| {
        let ways = case.ways(&one.task, &one.tools);
        (!ways.is_empty()).then(|| (one.explain)(&ways)).flatten()
    };
    // The searches are parallel in themselves, and the first cause ends them.
    let by_limits = || limits(&case).into_iter().find_map(relaxed);
    // No other limit matters for an enclosed object.
    let found = match &walls {
        Some(_) => obstructed(&case, walls.as_ref()).or_else(by_limits),
        None => by_limits().or_else(|| obstructed(&case, None)),
    };
    (!progress.cancelled()).then(|| found.unwrap_or(Cause::Several))
}
