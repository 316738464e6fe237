//! Rules of pushes: grip yaw, number, form, lift, direction, length and speed.

use crate::geometry::{Vector, wrap_angle};
use crate::outcome::{PushFault, Warning};
use crate::task::{Plan, PushForm, PushStep, Step, Task};

use super::SLACK;

/// Largest angle by which refinement may rotate a push away from the task's directions, radians (25
/// degrees).
const TURNED: f64 = 0.436_333;

/// Largest ratio by which refinement may lengthen a placed push.
const LONGER: f64 = 1.5;

/// Returns the grip yaws, the sequences of pushes and the single pushes that the task does not
/// allow.
pub(super) fn forbidden_pushes(task: &Task, plan: &Plan) -> Vec<Warning> {
    let mut found = forbidden_yaws(task, plan);
    found.extend(too_many(task, plan));
    found.extend(forbidden_forms(task, plan));
    found
}

/// Returns `true` if the tool is set down from above before step `index`, a push.
pub(super) fn comes_down(plan: &Plan, index: usize) -> bool {
    let chained = matches!(&plan.steps[index], Step::Push(step) if step.form == PushForm::Chained);
    let before = index.checked_sub(1).map(|before| &plan.steps[before]);
    !(chained && matches!(before, Some(Step::Push(_))))
}

/// Returns each grip yaw that the task does not allow, once for consecutive pushes.
fn forbidden_yaws(task: &Task, plan: &Plan) -> Vec<Warning> {
    let mut yaws: Vec<f64> = plan.push_steps().map(|step| step.grip_yaw).collect();
    yaws.dedup();
    yaws.retain(|yaw| {
        let same = |allowed: &f64| wrap_angle(allowed - yaw).abs() <= SLACK;
        !task.pushes.grip_yaws.iter().any(same)
    });
    yaws.into_iter().map(|yaw| Warning::ForbiddenYaw { yaw }).collect()
}

/// Returns the sequences of consecutive pushes that are longer than the task allows.
fn too_many(task: &Task, plan: &Plan) -> Vec<Warning> {
    let allowed = task.pushes.max_count;
    let rows = plan.steps.chunk_by(|a, b| matches!((a, b), (Step::Push(_), Step::Push(_))));
    let rows = rows.filter(|row| matches!(row[0], Step::Push(_))).map(<[Step]>::len);
    let long = rows.filter(|pushes| *pushes > allowed);
    long.map(|pushes| Warning::TooManyPushes { pushes, allowed }).collect()
}

/// Returns the pushes that violate the task's rules, each with its first fault.
fn forbidden_forms(task: &Task, plan: &Plan) -> Vec<Warning> {
    let headings = task.pushes.directions.headings();
    let mut found = Vec::new();
    let mut last = None;
    for (push, step) in plan.steps.iter().enumerate() {
        last = match step {
            Step::Push(step) => {
                let fault = form_fault(task, &headings, step, last);
                found.extend(fault.map(|fault| Warning::ForbiddenPush { push, fault }));
                Some(step.push.end())
            }
            // The tool is lifted before the lever-up.
            Step::LeverUp(_) => None,
        };
    }
    found
}

/// Returns the first fault of a push. `last` is the end of the directly preceding push.
fn form_fault(
    task: &Task,
    headings: &[f64],
    step: &PushStep,
    last: Option<Vector>,
) -> Option<PushFault> {
    let PushStep { form, lift, ref push, .. } = *step;
    let rules = &task.pushes;
    let off = |from: Vector| (push.start - from).norm();
    let turned = |angle: &f64| wrap_angle(angle - push.direction).abs() <= TURNED + SLACK;
    let chained = form == PushForm::Chained;
    if form != rules.form {
        return Some(PushFault::Form);
    }
    if (lift - rules.lift).abs() > SLACK {
        return Some(PushFault::Lift(lift));
    }
    match last {
        None if chained && off(task.robot.home) > SLACK => {
            return Some(PushFault::Home(off(task.robot.home)));
        }
        Some(end) if chained && off(end) > SLACK => return Some(PushFault::Apart(off(end))),
        _ => {}
    }
    if !headings.iter().any(turned) {
        return Some(PushFault::Direction(push.direction));
    }
    let longest = if chained { rules.length } else { LONGER * rules.length };
    if push.length > longest + SLACK {
        return Some(PushFault::Length(push.length));
    }
    ((push.speed - rules.speed).abs() > SLACK).then_some(PushFault::Speed(push.speed))
}
