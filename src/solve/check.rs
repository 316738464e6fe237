//! Check of tasks created in code, which may hold values that no file can have.

use std::sync::Arc;

use crate::{
    scene::{JointKind, Situation, Surface, Tool},
    task::{Offsets, Task},
};

use super::error::{SolveError, TaskFault};

/// Faults of a task, in the order of its keys.
#[derive(Default)]
pub(super) struct Ledger(Vec<TaskFault>);

impl Ledger {
    /// Notes a fault of the value at `key` unless it is `sound`.
    pub fn expect(&mut self, sound: bool, key: impl Into<String>, what: impl Into<String>) {
        if !sound {
            self.0.push(TaskFault { key: key.into(), what: what.into() });
        }
    }

    /// Returns an error with all faults if there are any.
    pub fn finish(self, task: &Task) -> Result<(), SolveError> {
        match self.0.is_empty() {
            true => Ok(()),
            false => Err(SolveError::BadTask { task: task.name.clone(), faults: self.0 }),
        }
    }
}

/// Checks every number that planning relies on, and the tools for pushes if given.
///
/// # Errors
/// Returns all faults.
pub(super) fn check<'a>(
    task: &Task,
    situation: &Situation,
    tools: impl Into<Option<&'a [Arc<Tool>]>>,
) -> Result<(), SolveError> {
    let mut ledger = common(task, situation);
    let tools: Option<&[Arc<Tool>]> = tools.into();
    for tool in tools.unwrap_or_default() {
        let sound = tool.grip.is_finite()
            && is_friction(tool.friction)
            && !tool.parts().is_empty()
            && tool.parts().iter().all(|part| {
                let (radius, area) = (part.footprint().bounding_radius(), part.footprint().area());
                part.pose.is_finite() && radius.is_finite() && area > 0.0
            });
        let what = format!(
            "tool `{}` needs parts of positive finite size, a finite grip and friction",
            tool.name
        );
        ledger.expect(sound, "tools", what);
    }
    ledger.expect(!tools.is_some_and(<[_]>::is_empty), "tools", "the task allows no tool");
    // An arm is asked about sound tools only.
    if let Some(arm) = task.arm.as_ref().filter(|_| ledger.0.is_empty()) {
        let refused = |tool: &Arc<Tool>| Some(arm.refuses(tool)?.0);
        let tool = tools.and_then(|tools| tools.iter().find_map(refused));
        let wrong = arm.fault().or(tool);
        ledger.expect(wrong.is_none(), "robot", wrong.unwrap_or_default());
    }
    ledger.finish(task)
}

/// Checks the values common to all tasks.
pub(super) fn common(task: &Task, situation: &Situation) -> Ledger {
    let mut ledger = Ledger::default();
    check_scene(&mut ledger, situation);
    check_bodies(&mut ledger, situation);
    check_robot(&mut ledger, task);
    check_pushes(&mut ledger, task);
    check_goals(&mut ledger, task, situation);
    ledger
}

fn check_scene(ledger: &mut Ledger, Situation { scene, start, physics }: &Situation) {
    let friction = physics.table_friction;
    let what = format!("the friction of the table is {friction}, but must not be negative");
    ledger.expect(is_friction(friction), "scene.table.friction", what);
    let ends = scene.table_top;
    let sound =
        ends.is_none_or(|top| top.size.iter().chain(top.middle.iter()).all(|v| v.is_finite()));
    ledger.expect(sound, "scene.table", "the size and position of the table must be finite");
    let count = scene.objects.len();
    let counts = [start.poses.len(), start.velocities.len(), physics.masses.len()];
    let complete = counts.iter().chain([&physics.frictions.len()]).all(|&n| n == count);
    ledger.expect(complete, "scene", "start and physics must have one entry per object");
    ledger.expect(start.is_finite(), "scene", "the start must be finite");
    let faults = scene.object_faults();
    for (key, what) in &faults {
        ledger.expect(false, key.clone(), *what);
    }
    let values = physics.masses.iter().zip(&physics.frictions).zip(&scene.objects);
    // Assumed physics are checked unless the stated values, from which they stem, are faulty.
    for ((mass, friction), object) in values.filter(|_| faults.is_empty()) {
        let sound = is_positive(*mass) && is_friction(*friction);
        let name = &object.name;
        let what = format!("the mass and friction of `{name}` must be positive and finite");
        ledger.expect(sound, "scene.objects", what);
    }
}

fn check_bodies(ledger: &mut Ledger, Situation { scene, physics, .. }: &Situation) {
    for (k, joint) in physics.joints.iter().enumerate() {
        let [a, b] = joint.between;
        let placed = match joint.kind {
            JointKind::Fixed => true,
            JointKind::Revolute { at, .. } => at.iter().all(|v| v.is_finite()),
            JointKind::Prismatic { axis, .. } => (axis.norm() - 1.0).abs() < 1e-6,
        };
        let limited = joint.limits().is_none_or(|span| span.low <= 0.0 && span.high >= 0.0);
        let sound = a != b && a.max(b) < scene.objects.len() && placed && limited;
        let what = format!(
            "the joint between objects {a} and {b} needs two different objects of the scene, a \
             finite unit axis and limits that contain the start"
        );
        ledger.expect(sound, format!("scene.joints[{k}]"), what);
    }
    for (k, pair) in physics.pairs.iter().enumerate() {
        let there = match pair.with {
            Surface::Object(other) => other < scene.objects.len() && other != pair.object,
            Surface::Obstacle(other) => other < scene.obstacles.len(),
            Surface::Table | Surface::Tool => true,
        };
        let sound = there && pair.object < scene.objects.len() && is_friction(pair.coefficient);
        let what = format!(
            "the friction of object {} and {:?} needs two different bodies of the scene and a \
             finite coefficient",
            pair.object, pair.with
        );
        ledger.expect(sound, format!("scene.frictions[{k}]"), what);
    }
    for (k, obstacle) in scene.obstacles.iter().enumerate() {
        let sound = obstacle.pose.is_finite()
            && obstacle.size.iter().all(|v| is_positive(*v))
            && is_friction(obstacle.friction);
        let what = format!(
            "obstacle `{}` needs a positive finite size, a finite position and friction",
            obstacle.name
        );
        ledger.expect(sound, format!("scene.obstacles[{k}]"), what);
    }
}

fn check_robot(ledger: &mut Ledger, task: &Task) {
    let robot = &task.robot;
    let (least, most) = (robot.reach_min, robot.reach_max);
    let what = format!("the smallest reach is {least}, but must not be negative");
    ledger.expect(is_friction(least), "robot.reach.min", what);
    let what = format!("the largest reach is {most}, but must be a positive number");
    ledger.expect(is_positive(most), "robot.reach.max", what);
    let home = robot.home.iter().all(|v| v.is_finite());
    ledger.expect(home, "robot.home", "the robot's home must be finite");
    let what = "the largest force of the robot must be a positive number";
    ledger.expect(robot.max_force.is_none_or(is_positive), "robot.max_force", what);
    for (name, cost) in &task.tool_costs {
        let what = format!("the cost of tool `{name}` is {cost}, but must not be negative");
        ledger.expect(is_friction(*cost), "tools", what);
    }
    let share = task.robustness;
    let what = format!("the robustness is {share}, but must not be negative");
    ledger.expect(is_friction(share), "robustness", what);
    let what = format!("the robustness is {share}, but must be at most 1");
    ledger.expect(share.is_nan() || share <= 1.0, "robustness", what);
}

fn check_pushes(ledger: &mut Ledger, task: &Task) {
    let rules = &task.pushes;
    for (key, name, value) in [("length", "length", rules.length), ("speed", "speed", rules.speed)]
    {
        let what = format!("the {name} of a push is {value}, but must be a positive number");
        ledger.expect(is_positive(value), format!("pushes.{key}"), what);
    }
    let what = format!("the lift is {}, but must not be negative", rules.lift);
    ledger.expect(is_friction(rules.lift), "pushes.lift", what);
    let finite = |list: &[f64]| !list.is_empty() && list.iter().all(|v| v.is_finite());
    let what = "the directions must be one or more finite numbers";
    ledger.expect(finite(&rules.directions.headings()), "pushes.directions_deg", what);
    let what = "the grip yaws must be one or more finite numbers";
    ledger.expect(finite(&rules.grip_yaws), "pushes.grip_yaws_deg", what);
    let offsets = match &rules.offsets {
        Offsets::List(list) => finite(list),
        Offsets::Effort => true,
    };
    ledger.expect(offsets, "pushes.offsets", "the offsets must be one or more finite numbers");
}

fn check_goals(ledger: &mut Ledger, task: &Task, Situation { scene, .. }: &Situation) {
    ledger.expect(!task.goals.is_empty(), "goal", "the task has no goal");
    for (k, goal) in task.goals.iter().enumerate() {
        let key = if task.goals.len() == 1 { "goal".to_owned() } else { format!("goal[{k}]") };
        let what = format!("the goal names object {}, which does not exist", goal.object);
        let exists = goal.object < scene.objects.len();
        ledger.expect(exists, key.clone(), what);
        let twice = task.goals.iter().take(k).any(|before| before.object == goal.object);
        ledger.expect(!twice, key.clone(), format!("object {} has two goals", goal.object));
        let wrong = goal.fault(scene).filter(|_| exists);
        ledger.expect(wrong.is_none(), key, wrong.unwrap_or_default());
    }
}

fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

fn is_friction(value: f64) -> bool {
    value.is_finite() && value >= 0.0
}
