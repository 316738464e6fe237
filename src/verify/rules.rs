//! What a plan does that its task does not allow, whatever it leads to.
//!
//! Written apart from the planner's own rules, which are stricter: it keeps distances; this only
//! says what no robot can do or the task forbids.

use std::sync::Arc;

use crate::geometry::{Footprint, Pose, Vector, clearance, swept_clearance, wrap_angle};
use crate::{
    outcome::{PushFault, Warning},
    scene::{Fixed, Mover, Robot, Scene, Tool},
    task::{Plan, Push, PushForm, PushStep, Task, ToolChoice, Way},
};

/// Slack for rounding, metres and radians.
const SLACK: f64 = 1e-5;

/// How far refinement may turn a push away from the directions of a task, radians (25 degrees), and
/// how much longer than the task says it may make it.
const TURNED: f64 = 0.436_333;
const LONGER: f64 = 1.5;

/// Everything that is wrong with `plan`, which those of `tools` that it names carry out in `scene`, before
/// anything moves.
pub fn broken_rules(task: &Task, scene: &Scene, tools: &[Arc<Tool>], plan: &Plan) -> Vec<Warning> {
    let mut found = Vec::new();
    if plan.is_empty() {
        return found;
    }
    if let ToolChoice::Named(names) = &task.tools {
        let forbidden =
            plan.tools().into_iter().filter(|tool| !names.iter().any(|name| name == tool));
        found.extend(forbidden.map(|tool| Warning::ForbiddenTool { tool: tool.to_owned() }));
    }
    let steps: Vec<&PushStep> = plan.push_steps().collect();
    let changes = steps.windows(2).filter(|pair| pair[0].tool != pair[1].tool).count();
    let allowed = task.tool_changes();
    if changes > allowed {
        found.push(Warning::TooManyToolChanges { changes, allowed });
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
    let named = |step: &PushStep| tools.iter().find(|tool| tool.name == step.tool);
    for (index, step) in steps.iter().enumerate() {
        let Some(tool) = named(step) else { continue };
        if !is_within_reach(&task.robot, &step.push) {
            found.push(Warning::OutOfReach { push: index });
        }
        let set_down = step.form == PushForm::Placed || index == 0;
        if let Some(obstacle) = in_the_way(scene, tool, step, set_down) {
            found.push(Warning::ThroughObstacle { push: index, obstacle });
        }
        if let Some(obstacle) = at_the_hand(task, scene, tool, step, set_down) {
            found.push(Warning::HandThrough { push: index, obstacle });
        }
    }
    // Another tool comes from wherever tools are kept.
    for (before, pair) in
        steps.windows(2).enumerate().filter(|(_, pair)| pair[0].tool == pair[1].tool)
    {
        if let Some(tool) = named(pair[0])
            && let Some(Way::Blocked(obstacle)) = task.way_between(scene, tool, [pair[0], pair[1]])
        {
            found.push(Warning::NoWay { push: before + 1, obstacle });
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
        if push.length > LONGER * rules.length + SLACK {
            return Some(PushFault::Length(push.length));
        }
        (push.speed > rules.speed + SLACK).then_some(PushFault::Speed(push.speed))
    };
    let faults: Vec<Option<PushFault>> = plan.push_steps().map(fault).collect();
    let faults = faults.into_iter().enumerate();
    faults
        .filter_map(|(push, fault)| Some(Warning::ForbiddenPush { push, fault: fault? }))
        .collect()
}

/// What fixed thing the tool runs into during a push, or when it comes down from above before it.
pub(super) fn in_the_way(
    scene: &Scene,
    tool: &Tool,
    step: &PushStep,
    set_down: bool,
) -> Option<String> {
    let ends = ends(tool, step);
    (0..tool.parts().len()).find_map(|k| {
        let (shape, ends) = (tool.parts()[k].footprint(), ends.map(|at| tool.part_pose(k, &at)));
        let span = [step.lift, step.lift + tool.parts()[k].shape.height()];
        met(scene, Mover::Tool, (&shape, ends, span), set_down)
    })
}

/// What fixed thing the hand, or the handle that it holds the tool by, runs into.
fn at_the_hand(
    task: &Task,
    scene: &Scene,
    tool: &Tool,
    step: &PushStep,
    set_down: bool,
) -> Option<String> {
    let ends = ends(tool, step);
    task.robot.carried(tool, step.lift).into_iter().flatten().find_map(|carried| {
        let ends = ends.map(|at| at * carried.pose);
        met(scene, Mover::Hand, (&carried.footprint, ends, carried.span), set_down)
    })
}

/// The poses of a tool before and after a push.
fn ends(tool: &Tool, step: &PushStep) -> [Pose; 2] {
    let at = |at: Vector| tool.pose(Pose { position: at, heading: step.grip_yaw });
    [at(step.push.start), at(step.push.end())]
}

/// The name of what something runs into on its way, or on its way down to where that begins.
fn met(
    scene: &Scene,
    mover: Mover,
    (shape, [from, to], span): (&Footprint, [Pose; 2], [f64; 2]),
    set_down: bool,
) -> Option<String> {
    let on_the_way = |fixed: &Fixed| {
        let still = (&fixed.footprint, &fixed.pose);
        swept_clearance(shape, &from, &to, still, SLACK) <= 0.0
    };
    let on_the_way_down = |fixed: &Fixed| {
        set_down && clearance((shape, &from), (&fixed.footprint, &fixed.pose), SLACK) <= 0.0
    };
    let mut fixed = scene.fixed(mover, span);
    let found = fixed.find(on_the_way).or_else(|| scene.above(span[1]).find(on_the_way_down));
    found.map(|fixed| fixed.name.to_owned())
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
