//! Refuses tasks in space that were made in code and that no file could hold.

use std::sync::Arc;

use crate::{
    scene::{Situation, Tool},
    task::Task,
};

use super::SolveError;

/// Checks what planning in space relies on besides what holds for every task.
///
/// # Errors
/// The first fault.
pub(super) fn check_levers(
    task: &Task,
    situation: &Situation,
    blades: &[Arc<Tool>],
) -> Result<(), SolveError> {
    let fault = |what: String| Err(SolveError::BadTask { task: task.name.clone(), what });
    let positive = |value: f64| value.is_finite() && value > 0.0;
    let from_zero = |value: f64| value.is_finite() && value >= 0.0;
    let scene = &*situation.scene;
    let [goal] = &task.goals[..] else {
        return fault("where something leaves the plane there is one goal".into());
    };
    if goal.object >= scene.objects.len() {
        return fault(format!("the goal names object {}, which does not exist", goal.object));
    }
    if let Some(what) = goal.fault(scene) {
        return fault(what);
    }
    if scene.joints.iter().any(|joint| !scene.is_seam(joint))
        || !scene.frictions.is_empty()
        || scene.table_top.is_some()
    {
        let what = "joints, frictions of pairs and a table that ends are for tasks of pushes";
        return fault(what.into());
    }
    if let Some(what) = scene.object_fault() {
        return fault(what);
    }
    for obstacle in &scene.obstacles {
        let sound = obstacle.size.iter().all(|size| positive(*size))
            && from_zero(obstacle.z)
            && from_zero(obstacle.friction)
            && obstacle.pose.is_finite();
        if !sound {
            return fault(format!("obstacle `{}` needs a positive finite size", obstacle.name));
        }
    }
    let rules = task.lever_rules();
    let spans = [rules.depth, rules.angle];
    if !spans.iter().all(|[low, high]| positive(*low) && high.is_finite() && low <= high) {
        return fault("depths and angles need a smallest and a largest, both positive".into());
    }
    if !positive(rules.speed) || !from_zero(rules.hold) || !from_zero(rules.retreat) {
        return fault("speed, hold and retreat of the blade must be finite and positive".into());
    }
    if rules.pivots.is_empty() {
        return fault("it allows no pivot".into());
    }
    if !(positive(task.robot.reach_max) && (0.0..=1.0).contains(&task.robustness)) {
        return fault("reach and robustness make no sense".into());
    }
    if !from_zero(scene.table_friction) {
        return fault("the friction of the table must not be negative".into());
    }
    for tool in blades {
        let blade = tool.blade().unwrap_or_default();
        let sizes = [blade.length, blade.width, blade.thickness];
        if !(sizes.into_iter().all(positive) && from_zero(blade.friction)) {
            return fault(format!("tool `{}` needs a blade of positive size", tool.name));
        }
    }
    if task.levers.is_some() && blades.is_empty() {
        return fault("it allows no tool with a blade".into());
    }
    if task.levers.is_none() && task.pushes.max_count == 0 {
        return fault("it allows neither pushes nor lever-ups".into());
    }
    Ok(())
}
