//! What a plan does that its task does not allow, whatever it leads to.
//!
//! Written apart from the planner's own rules, which are stricter: it keeps distances; this only
//! says what no robot can do or the task forbids.

use crate::geometry::{Footprint, Pose, Vector, swept_clearance, wrap_angle};
use crate::scene::{
    Obstacle, Plan, Push, PushFault, PushForm, PushStep, Region, Robot, Scene, Task, Tool,
    ToolChoice, Warning,
};

/// Slack for rounding, metres and radians.
const SLACK: f64 = 1e-5;

/// How far refinement may turn a push away from the directions of a task, radians (25 degrees), and
/// how much longer than the task says it may make it.
const TURNED: f64 = 0.436_333;
const LONGER: f64 = 1.5;

/// Everything that is wrong with `plan`, which `tool` carries out in `scene`, before anything
/// moves.
pub fn broken_rules(task: &Task, scene: &Scene, tool: &Tool, plan: &Plan) -> Vec<Warning> {
    let mut found = Vec::new();
    if plan.is_empty() {
        return found;
    }
    if let ToolChoice::Named(names) = &task.tools
        && !names.contains(&tool.name)
    {
        found.push(Warning::ForbiddenTool { tool: tool.name.clone() });
    }
    let mut yaws: Vec<f64> = plan.push_steps().map(|step| step.grip_yaw).collect();
    yaws.dedup();
    for yaw in yaws {
        let same = |allowed: &f64| wrap_angle(allowed - yaw).abs() <= SLACK;
        if !task.pushes.grip_yaws.iter().any(same) {
            found.push(Warning::ForbiddenYaw { yaw });
        }
    }
    let pushes = plan.push_steps().count();
    if pushes > task.pushes.max_count {
        found.push(Warning::TooManyPushes { pushes, allowed: task.pushes.max_count });
    }
    found.extend(forms(task, plan));
    for (index, step) in plan.push_steps().enumerate() {
        if !is_within_reach(&task.robot, &step.push) {
            found.push(Warning::OutOfReach { push: index });
        }
        if let Some(obstacle) = in_the_way(&scene.obstacles, tool, step)
            .map(|obstacle| &obstacle.name)
            .or_else(|| tool_in(scene, tool, step))
        {
            let obstacle = obstacle.clone();
            found.push(Warning::ThroughObstacle { push: index, obstacle });
        }
        if let Some(obstacle) = at_the_hand(task, scene, tool, step) {
            let obstacle = obstacle.clone();
            found.push(Warning::HandThrough { push: index, obstacle });
        }
    }
    found
}

/// The pushes that are not of the form that the task allows, each with the first fault.
fn forms(task: &Task, plan: &Plan) -> Vec<Warning> {
    let (rules, allowed) = (&task.pushes, task.pushes.directions.headings());
    let mut last = None;
    let fault = |step: &PushStep| {
        let PushStep { form, lift, ref push, .. } = *step;
        let before = last.replace(push.end());
        let off = |from: Vector| (push.start - from).norm();
        let turned = |angle: &f64| wrap_angle(angle - push.direction).abs() <= TURNED + SLACK;
        let chained = form == PushForm::Chained;
        if form != rules.form {
            return Some(PushFault::Form);
        }
        if (lift - rules.lift).abs() > SLACK {
            return Some(PushFault::Lift(lift));
        }
        match before {
            None if chained && off(task.robot.home) > SLACK => {
                return Some(PushFault::Home(off(task.robot.home)));
            }
            Some(end) if chained && off(end) > SLACK => return Some(PushFault::Apart(off(end))),
            _ => {}
        }
        if !allowed.iter().any(turned) {
            return Some(PushFault::Direction(push.direction));
        }
        (push.length > LONGER * rules.length + SLACK).then_some(PushFault::Length(push.length))
    };
    let faults: Vec<Option<PushFault>> = plan.push_steps().map(fault).collect();
    let faults = faults.into_iter().enumerate();
    faults
        .filter_map(|(push, fault)| Some(Warning::ForbiddenPush { push, fault: fault? }))
        .collect()
}

/// The first obstacle that the tool goes through during a push.
pub(super) fn in_the_way<'a>(
    obstacles: &'a [Obstacle],
    tool: &Tool,
    step: &PushStep,
) -> Option<&'a Obstacle> {
    let frame = |at: Vector| tool.pose(Pose { position: at, heading: step.grip_yaw });
    let (from, to) = (frame(step.push.start), frame(step.push.end()));
    obstacles.iter().find(|obstacle| {
        let still = (&obstacle.shape().footprint(), &obstacle.pose);
        let meets = |k: usize| {
            let (part, ends) = (tool.parts()[k].footprint(), [from, to]);
            let [from, to] = ends.map(|frame| tool.part_pose(k, &frame));
            swept_clearance(&part, &from, &to, still, SLACK) <= 0.0
        };
        step.lift < obstacle.size[2] && (0..tool.parts().len()).any(meets)
    })
}

/// The first obstacle that the hand, or the handle that it holds the tool by, goes through.
fn at_the_hand<'a>(
    task: &Task,
    scene: &'a Scene,
    tool: &Tool,
    step: &PushStep,
) -> Option<&'a String> {
    let frame = |at: Vector| tool.pose(Pose { position: at, heading: step.grip_yaw });
    let (from, to) = (frame(step.push.start), frame(step.push.end()));
    let carried = task.robot.carried(tool, step.lift).into_iter().flatten();
    let mut carried = carried.map(|one| (one, from * one.pose, to * one.pose));
    carried.find_map(|(one, from, to)| {
        let met = |footprint: &Footprint, pose: &Pose| {
            swept_clearance(&one.footprint, &from, &to, (footprint, pose), SLACK) <= 0.0
        };
        let obstacle = scene.obstacles.iter().find(|obstacle| {
            one.from < obstacle.size[2] && met(&obstacle.shape().footprint(), &obstacle.pose)
        });
        let mut regions = scene.keep_out.iter().filter(|region| region.hand);
        let mut region = || regions.find(|region| met(&region.footprint(), &region.pose));
        obstacle.map(|one| &one.name).or_else(|| Some(&region()?.name))
    })
}

/// The first region that the tool goes through and keeps out of.
fn tool_in<'a>(scene: &'a Scene, tool: &Tool, step: &PushStep) -> Option<&'a String> {
    let frame = |at: Vector| tool.pose(Pose { position: at, heading: step.grip_yaw });
    let ends = [frame(step.push.start), frame(step.push.end())];
    let mut regions = scene.keep_out.iter().filter(|region| region.tool);
    let through = |region: &&Region| {
        let still = (&region.footprint(), &region.pose);
        (0..tool.parts().len()).any(|k| {
            let [from, to] = ends.map(|frame| tool.part_pose(k, &frame));
            swept_clearance(&tool.parts()[k].footprint(), &from, &to, still, SLACK) <= 0.0
        })
    };
    regions.find(through).map(|region| &region.name)
}

/// Whether the end effector is within reach all along a push.
pub(super) fn is_within_reach(robot: &Robot, push: &Push) -> bool {
    let (from, to) = (push.start, push.end());
    let way = to - from;
    let square = way.norm_squared();
    let nearest = if square > 0.0 { (-from.dot(&way) / square).clamp(0.0, 1.0) } else { 0.0 };
    from.norm().max(to.norm()) <= robot.reach_max + SLACK
        && (from + nearest * way).norm() >= robot.reach_min - SLACK
}
