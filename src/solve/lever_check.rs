//! Check of tasks with lever-ups created in code, which may hold values that no file can have.

use std::sync::Arc;

use crate::{
    scene::{Situation, Tool},
    task::Task,
};

use super::SolveError;
use super::check::check;

/// Checks the values that planning of lever-ups relies on, and those common to all tasks.
///
/// # Errors
/// Returns the first fault.
pub(super) fn check_levers(
    task: &Task,
    situation: &Situation,
    blades: &[Arc<Tool>],
) -> Result<(), SolveError> {
    check(task, situation, None)?;
    let fault = |what: String| Err(SolveError::BadTask { task: task.name.clone(), what });
    let positive = |value: f64| value.is_finite() && value > 0.0;
    let from_zero = |value: f64| value.is_finite() && value >= 0.0;
    if task.arm.is_some() {
        return fault("lever-ups are planned for a hand, not for the joints of an arm".into());
    }
    let rules = task.lever_rules();
    let spans = [rules.depth, rules.angle];
    if !spans.iter().all(|[low, high]| positive(*low) && high.is_finite() && low <= high) {
        return fault(
            "depths and angles need a smallest and a largest value, both positive".into(),
        );
    }
    if !positive(rules.speed) || !from_zero(rules.hold) || !from_zero(rules.retreat) {
        return fault("speed, hold and retreat of the blade must be finite and positive".into());
    }
    if rules.pivots.is_empty() {
        return fault("the task allows no pivot".into());
    }
    for tool in blades {
        let blade = tool.blade().unwrap_or_default();
        let sizes = [blade.length, blade.width, blade.thickness];
        if !(sizes.into_iter().all(positive) && from_zero(blade.friction)) {
            return fault(format!("tool `{}` needs a blade of positive size", tool.name));
        }
    }
    if task.levers.is_some() && blades.is_empty() {
        return fault("the task allows no tool with a blade".into());
    }
    if task.levers.is_none() && task.pushes.max_count == 0 {
        return fault("the task allows neither pushes nor lever-ups".into());
    }
    Ok(())
}
