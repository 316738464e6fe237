//! Check of tasks created in code, which may hold values that no file can have.

use std::sync::Arc;

use crate::{
    scene::{JointKind, Situation, Surface, Tool},
    task::{Offsets, Task},
};

use super::SolveError;

/// Checks every number that planning relies on, and the tools for pushes if given.
///
/// # Errors
/// Returns the first fault.
pub(super) fn check<'a>(
    task: &Task,
    situation: &Situation,
    tools: impl Into<Option<&'a [Arc<Tool>]>>,
) -> Result<(), SolveError> {
    let fault = |what: String| Err(SolveError::BadTask { task: task.name.clone(), what });
    let (rules, robot) = (&task.pushes, &task.robot);
    let Situation { scene, start, physics } = situation;
    for (name, value) in [
        ("the length of a push", rules.length),
        ("the speed of a push", rules.speed),
        ("the largest reach", robot.reach_max),
    ] {
        if !(value.is_finite() && value > 0.0) {
            return fault(format!("{name} is {value}, but must be a positive number"));
        }
    }
    for (name, value) in [
        ("the lift", rules.lift),
        ("the smallest reach", robot.reach_min),
        ("the friction of the table", physics.table_friction),
        ("the robustness", task.robustness),
    ] {
        if !(value.is_finite() && value >= 0.0) {
            return fault(format!("{name} is {value}, but must not be negative"));
        }
    }
    if task.robustness > 1.0 {
        return fault(format!("the robustness is {}, but must be at most 1", task.robustness));
    }
    if robot.max_force.is_some_and(|force| !(force.is_finite() && force > 0.0)) {
        return fault("the largest force of the robot must be a positive number".into());
    }
    if task.tool_costs.values().any(|cost| !(cost.is_finite() && *cost >= 0.0)) {
        return fault("the cost of a tool must not be negative".into());
    }
    let ends = scene.table_top;
    if ends.is_some_and(|top| !top.size.iter().chain(top.middle.iter()).all(|v| v.is_finite())) {
        return fault("the size and position of the table must be finite".into());
    }
    let headings = rules.directions.headings();
    let lists: [(&str, &[f64]); 2] = [("directions", &headings), ("grip yaws", &rules.grip_yaws)];
    for (name, list) in lists {
        if list.is_empty() || list.iter().any(|v| !v.is_finite()) {
            return fault(format!("the {name} must be one or more finite numbers"));
        }
    }
    if let Offsets::List(list) = &rules.offsets
        && (list.is_empty() || list.iter().any(|v| !v.is_finite()))
    {
        return fault("the offsets must be one or more finite numbers".into());
    }
    if task.goals.is_empty() {
        return fault("the task has no goal".into());
    }
    for (k, goal) in task.goals.iter().enumerate() {
        if goal.object >= scene.objects.len() {
            return fault(format!("the goal names object {}, which does not exist", goal.object));
        }
        if task.goals.iter().take(k).any(|before| before.object == goal.object) {
            return fault(format!("object {} has two goals", goal.object));
        }
        if let Some(what) = goal.fault(scene) {
            return fault(what);
        }
    }
    if !robot.home.iter().all(|v| v.is_finite()) {
        return fault("the robot's home must be finite".into());
    }
    let counts = [start.poses.len(), start.velocities.len(), physics.masses.len()];
    if counts.iter().chain([&physics.frictions.len()]).any(|&n| n != scene.objects.len()) {
        return fault("start and physics must have one entry per object".into());
    }
    if !start.is_finite() {
        return fault("the start must be finite".into());
    }
    if let Some(what) = scene.object_fault() {
        return fault(what);
    }
    for (k, object) in scene.objects.iter().enumerate() {
        let mass = physics.masses[k];
        if !(mass.is_finite() && mass > 0.0 && is_friction(physics.frictions[k])) {
            let name = &object.name;
            return fault(format!("the mass and friction of `{name}` must be positive and finite"));
        }
    }
    for joint in &physics.joints {
        let [a, b] = joint.between;
        let placed = match joint.kind {
            JointKind::Fixed => true,
            JointKind::Revolute { at, .. } => at.iter().all(|v| v.is_finite()),
            JointKind::Prismatic { axis, .. } => (axis.norm() - 1.0).abs() < 1e-6,
        };
        let limited = joint.limits().is_none_or(|span| span.low <= 0.0 && span.high >= 0.0);
        if a == b || a.max(b) >= scene.objects.len() || !placed || !limited {
            return fault(format!(
                "the joint between objects {a} and {b} needs two different objects of the scene, a \
                 finite unit axis and limits that contain the start"
            ));
        }
    }
    for pair in &physics.pairs {
        let there = match pair.with {
            Surface::Object(other) => other < scene.objects.len() && other != pair.object,
            Surface::Obstacle(other) => other < scene.obstacles.len(),
            Surface::Table | Surface::Tool => true,
        };
        if !there || pair.object >= scene.objects.len() || !is_friction(pair.coefficient) {
            return fault(format!(
                "the friction of object {} and {:?} needs two different bodies of the scene and a \
                 finite coefficient",
                pair.object, pair.with
            ));
        }
    }
    for obstacle in &scene.obstacles {
        let sound = obstacle.pose.is_finite()
            && obstacle.size.iter().all(|v| v.is_finite() && *v > 0.0)
            && is_friction(obstacle.friction);
        if !sound {
            return fault(format!(
                "obstacle `{}` needs a positive finite size, a finite position and friction",
                obstacle.name
            ));
        }
    }
    let tools: Option<&[Arc<Tool>]> = tools.into();
    for tool in tools.unwrap_or_default() {
        let sound = tool.grip.is_finite()
            && is_friction(tool.friction)
            && !tool.parts().is_empty()
            && tool.parts().iter().all(|part| {
                let (radius, area) = (part.footprint().bounding_radius(), part.footprint().area());
                part.pose.is_finite() && radius.is_finite() && area > 0.0
            });
        if !sound {
            return fault(format!(
                "tool `{}` needs parts of positive finite size, a finite grip and friction",
                tool.name
            ));
        }
    }
    if let Some(arm) = &task.arm {
        let refused = |tool: &Arc<Tool>| Some(arm.refuses(tool)?.0);
        let tool = tools.and_then(|tools| tools.iter().find_map(refused));
        if let Some(wrong) = arm.fault().or(tool) {
            return fault(wrong);
        }
    }
    if tools.is_some_and(<[_]>::is_empty) {
        return fault("the task allows no tool".into());
    }
    Ok(())
}

fn is_friction(value: f64) -> bool {
    value.is_finite() && value >= 0.0
}
