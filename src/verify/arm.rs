//! Check that the arm of a task can execute a plan, by the joint trajectory stated with the plan or
//! by one computed for it.

use std::sync::Arc;

use crate::{
    outcome::{Evidence, Warning, step_states},
    scene::{JointTrajectory, Situation, Tool},
    task::{Followed, Plan, Task},
};

/// Returns the joint trajectory of the task's arm for a plan with these replays; `None` without an
/// arm.
pub fn joints(
    task: &Task,
    situation: &Situation,
    tool: &Arc<Tool>,
    plan: &Plan,
    evidence: &[Evidence],
) -> Option<Followed> {
    let arm = task.arm.as_deref()?;
    let states = step_states(&situation.start, plan.steps.len(), evidence);
    Some(arm.follow(task, &situation.scene, tool, plan, &states))
}

/// Returns a warning for every push that the arm cannot execute.
pub(super) fn arm_faults(
    (task, situation): (&Task, &Situation),
    tools: &[Arc<Tool>],
    plan: &Plan,
    evidence: &[Evidence],
    stated: Option<&JointTrajectory>,
) -> Vec<Warning> {
    let tool = tools.iter().find(|tool| tool.name == plan.tool());
    // The rule book refuses lever-ups by an arm.
    let asked = task.arm.as_deref().zip(tool).filter(|_| !plan.levers());
    let Some((arm, tool)) = asked else { return Vec::new() };
    let made = match stated {
        Some(stated) => Ok(stated.clone()),
        None => match joints(task, situation, tool, plan, evidence) {
            Some(made) => made,
            None => return Vec::new(),
        },
    };
    let faults = match made {
        Ok(path) => {
            let states = step_states(&situation.start, plan.steps.len(), evidence);
            arm.judge(&situation.scene, tool, plan, &states, &path)
        }
        Err(fault) => vec![fault],
    };
    faults.into_iter().map(|(push, fault)| Warning::Arm { push, fault }).collect()
}
