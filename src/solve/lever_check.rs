//! Check of tasks with lever-ups created in code, which may hold values that no file can have.

use std::sync::Arc;

use crate::{
    scene::{Situation, Tool},
    task::Task,
};

use super::SolveError;
use super::check::common;

/// Checks the values that planning of lever-ups relies on, and those common to all tasks.
///
/// # Errors
/// Returns all faults.
pub(super) fn check_levers(
    task: &Task,
    situation: &Situation,
    blades: &[Arc<Tool>],
) -> Result<(), SolveError> {
    let mut ledger = common(task, situation);
    let positive = |value: f64| value.is_finite() && value > 0.0;
    let from_zero = |value: f64| value.is_finite() && value >= 0.0;
    let what = "lever-ups are planned for a hand, not for the joints of an arm";
    ledger.expect(task.arm.is_none(), "robot", what);
    let rules = task.lever_rules();
    let span = |[low, high]: [f64; 2]| positive(low) && high.is_finite() && low <= high;
    let what = "depths and angles need a smallest and a largest value, both positive";
    ledger.expect(span(rules.depth), "levers.depth", what);
    ledger.expect(span(rules.angle), "levers.angle_deg", what);
    let what = "speed, hold and retreat of the blade must be finite and positive";
    let sound = positive(rules.speed) && from_zero(rules.hold) && from_zero(rules.retreat);
    ledger.expect(sound, "levers", what);
    ledger.expect(!rules.pivots.is_empty(), "levers.pivots", "the task allows no pivot");
    for tool in blades {
        let blade = tool.blade().unwrap_or_default();
        let sizes = [blade.length, blade.width, blade.thickness];
        let sound = sizes.into_iter().all(positive) && from_zero(blade.friction);
        let what = format!("tool `{}` needs a blade of positive size", tool.name);
        ledger.expect(sound, "tools", what);
    }
    let bladed = task.levers.is_none() || !blades.is_empty();
    ledger.expect(bladed, "tools", "the task allows no tool with a blade");
    let allowed = task.levers.is_some() || task.pushes.max_count > 0;
    ledger.expect(allowed, "pushes", "the task allows neither pushes nor lever-ups");
    ledger.finish(task)
}
