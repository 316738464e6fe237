//! Plans specified by a user: pushes given by their start or by the object that they meet.
//!
//! Nothing is searched. A push in front of an object is placed relative to the state after the
//! previous pushes, computed by the 2-D engine.

use std::sync::Arc;

use thiserror::Error;

use crate::geometry::Vector;
use crate::plan::{CandidatePush, Infeasible, Placement, Start, Workspace};
use crate::sim::Simulator;
use crate::{
    outcome::Record,
    scene::{Situation, State, Tool},
    task::{Job, Plan, Push, PushForm, Task},
};

/// Maximum distance of a chained push's stated start from the end of the last push, metres.
const SAME_PLACE: f64 = 1e-6;

/// Push specified by a user.
#[derive(Clone, Debug, PartialEq)]
pub struct ManualPush {
    /// Start of the push.
    pub start: ManualStart,
    /// Direction, radians from world +x.
    pub direction: f64,
    /// Travel, metres; `None` for the task's length.
    pub length: Option<f64>,
    /// Speed, m/s; `None` for the task's speed.
    pub speed: Option<f64>,
}

/// Start of a push.
#[derive(Clone, Debug, PartialEq)]
pub enum ManualStart {
    /// Position of the end effector, metres.
    At(Vector),
    /// Home, or the end of the last push (chained pushes).
    Last,
    /// Just in front of an object, by the first part of the tool that can push it without violating
    /// a rule, otherwise by the first that can push it.
    Before {
        /// Name of the object.
        object: String,
        /// Lateral offset, metres.
        offset: f64,
    },
}

/// Error of a push that cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ActionError {
    /// A chained push has a start of its own.
    #[error("chained pushes start at the end of the previous push")]
    ChainBroken,
    /// A chained push starts in front of an object.
    #[error("the pushes of this task are chained, so the first one starts at home")]
    Chained,
    /// A placed push has no start.
    #[error("a push of this task needs a start")]
    NoStart,
    /// No object has this name.
    #[error("no object is called `{object}`")]
    NoObject {
        /// The unknown name.
        object: String,
    },
    /// No part of the tool can push the object in this direction.
    #[error("`{tool}` cannot push `{object}` that way: {why}")]
    CannotPush {
        /// Name of the tool.
        tool: String,
        /// Name of the object.
        object: String,
        /// Reason for the last part of the tool.
        why: Infeasible,
    },
    /// The tool has a blade.
    #[error("`{tool}` has a blade, so it cannot push")]
    Blade {
        /// Name of the tool.
        tool: String,
    },
    /// The list of grip yaws is empty.
    #[error("the task has no grip yaw")]
    NoYaw,
}

/// Plan with the rules of its task that it violates.
#[derive(Clone, Debug, PartialEq)]
pub struct ManualPlan {
    /// The plan.
    pub plan: Plan,
    /// Violated rules with the index of the push. Plans found by a search violate none.
    pub violations: Vec<(usize, Infeasible)>,
}

/// Returns the plan of `pushes` with the first of `grip_yaws` (radians) that is feasible.
///
/// # Errors
/// Returns the fault with the first grip yaw. A push that violates a rule of the task (reach,
/// obstacles) is not an error, because its outcome may be of interest.
pub fn manual_plan(
    task: &Task,
    situation: &Situation,
    tool: &Arc<Tool>,
    grip_yaws: &[f64],
    pushes: &[ManualPush],
) -> Result<ManualPlan, ActionError> {
    if !tool.pushes() {
        return Err(ActionError::Blade { tool: tool.name.clone() });
    }
    let mut refused = ActionError::NoYaw;
    for (k, &grip_yaw) in grip_yaws.iter().enumerate() {
        match with_yaw(task, situation, tool, grip_yaw, pushes) {
            Ok(asked) => return Ok(asked),
            Err(error) if k == 0 => refused = error,
            Err(_) => {}
        }
    }
    Err(refused)
}

fn with_yaw(
    task: &Task,
    situation: &Situation,
    tool: &Arc<Tool>,
    grip_yaw: f64,
    pushes: &[ManualPush],
) -> Result<ManualPlan, ActionError> {
    let rules = &task.pushes;
    let (form, lift) = (rules.form, rules.lift);
    let mut plan = Plan::default();
    let mut violations = Vec::new();
    let mut state = situation.start.clone();
    for (k, asked) in pushes.iter().enumerate() {
        let previous = plan.push_steps().last().map(|step| step.push.end());
        let (placement, pushed) = start(task, (tool, grip_yaw), asked, &state, previous)?;
        let push = Push {
            start: placement.start,
            direction: asked.direction,
            length: asked.length.unwrap_or(rules.length),
            speed: asked.speed.unwrap_or(rules.speed),
        };
        let set_down = (k == 0 || form == PushForm::Placed).then_some(placement);
        let tools = std::slice::from_ref(tool);
        let workspace = Workspace { task, tools };
        let rule = workspace.margins((0, grip_yaw), (&state, pushed), &push, set_down).violation();
        violations.extend(rule.map(|rule| (k, rule)));
        let made = Plan::pushing(&tool.name, grip_yaw, form, lift, [push]);
        // The start of a chained push does not depend on the objects.
        if form == PushForm::Placed && k + 1 < pushes.len() {
            state = after(situation, tool, &made, state);
        }
        plan = plan.then(made);
    }
    Ok(ManualPlan { plan, violations })
}

/// Returns the state after a push from `start`. It is bitwise equal to the state if all previous
/// pushes had been replayed together with it.
fn after(situation: &Situation, tool: &Arc<Tool>, push: &Plan, start: State) -> State {
    let job = Job { start, ..Job::new(situation, push.motion(tool)) };
    Simulator::planar().run(&situation.scene, &job, Record::Outcome).outcome().clone()
}

/// Returns the placement of the push and the index of its object.
fn start(
    task: &Task,
    (tool, grip_yaw): (&Arc<Tool>, f64),
    asked: &ManualPush,
    state: &State,
    previous: Option<Vector>,
) -> Result<(Placement, usize), ActionError> {
    let goal = task.goals[0].object;
    let chained = task.pushes.form == PushForm::Chained;
    let (object, offset) = match &asked.start {
        ManualStart::At(at) => {
            let elsewhere = |end: Vector| (end - at).norm() > SAME_PLACE;
            let broken = chained && previous.is_some_and(elsewhere);
            return if broken {
                Err(ActionError::ChainBroken)
            } else {
                Ok((Placement::at(*at), goal))
            };
        }
        ManualStart::Last if chained => {
            let start = previous.unwrap_or(task.robot.home);
            return Ok((Placement::at(start), goal));
        }
        ManualStart::Last => return Err(ActionError::NoStart),
        ManualStart::Before { .. } if chained => return Err(ActionError::Chained),
        ManualStart::Before { object, offset } => (object, *offset),
    };
    let index = task
        .scene
        .object(object)
        .ok_or_else(|| ActionError::NoObject { object: object.clone() })?;
    let tools = std::slice::from_ref(tool);
    let workspace = Workspace { task, tools };
    let (direction, rules) = (asked.direction, &task.pushes);
    let (length, speed) =
        (asked.length.unwrap_or(rules.length), asked.speed.unwrap_or(rules.speed));
    let mut why = Infeasible::NoContact;
    let mut first = None;
    for part in 0..tool.parts().len() {
        let start = Start::Placed { part, offset };
        let (tool, room) = (0, 0.0);
        let push = CandidatePush { tool, grip_yaw, object: index, start, direction, length, room };
        match workspace.place(state, &push, previous) {
            Ok(placement) => {
                let push = Push { start: placement.start, direction, length, speed };
                let pushed = (state, index);
                let margins = workspace.margins((0, grip_yaw), pushed, &push, Some(placement));
                if margins.violation().is_none() {
                    return Ok((placement, index));
                }
                first.get_or_insert(placement);
            }
            Err(infeasible) => why = infeasible,
        }
    }
    let refused =
        || ActionError::CannotPush { tool: tool.name.clone(), object: object.clone(), why };
    first.map(|placement| (placement, index)).ok_or_else(refused)
}
