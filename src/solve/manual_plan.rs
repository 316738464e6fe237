//! A plan that a person asks for: pushes given by where they start, or by the object they meet.
//!
//! Nothing is searched. A push before an object is placed where the pushes before it leave the
//! objects, by the planar simulation.

use std::sync::Arc;

use thiserror::Error;

use crate::geometry::Vector;
use crate::plan::{CandidatePush, Infeasible, Start, Workspace};
use crate::sim::Simulator;
use crate::{
    outcome::Record,
    scene::{Situation, State, Tool},
    task::{Job, Plan, Push, PushForm, Task},
};

/// Maximum distance of a chained push's stated start from the end of the last push, metres.
const SAME_PLACE: f64 = 1e-6;

/// A push as a person asks for it.
#[derive(Clone, Debug, PartialEq)]
pub struct ManualPush {
    /// Start.
    pub start: ManualStart,
    /// Radians from world +x.
    pub direction: f64,
    /// Travel, metres; the task's if not given.
    pub length: Option<f64>,
    /// Speed, m/s; the task's if not given.
    pub speed: Option<f64>,
}

/// Start of a push.
#[derive(Clone, Debug, PartialEq)]
pub enum ManualStart {
    /// The end effector's position, metres.
    At(Vector),
    /// Home, or the end of the last push (chained pushes).
    Last,
    /// Just before this object, by the first part of the tool that can push it without breaking a
    /// rule, or else the first that can.
    Before {
        /// Its name.
        object: String,
        /// Lateral offset, metres.
        offset: f64,
    },
}

/// Errors of pushes that cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ActionError {
    /// A chained push with a start of its own.
    #[error("chained pushes go on where the last one ended")]
    ChainBroken,
    /// A chained push before an object.
    #[error("the pushes of this task are chained: the first starts at home")]
    Chained,
    /// A placed push without a start.
    #[error("a push of this task needs a start")]
    NoStart,
    /// A name that no object has.
    #[error("no object is called `{object}`")]
    NoObject {
        /// The name.
        object: String,
    },
    /// An object that no part of the tool can push that way.
    #[error("`{tool}` cannot push `{object}` that way: {why}")]
    CannotPush {
        /// The tool's name.
        tool: String,
        /// The object's name.
        object: String,
        /// Reason why the tool's last part cannot.
        why: Infeasible,
    },
    /// A tool with a blade.
    #[error("`{tool}` has a blade, so it cannot push")]
    Blade {
        /// The tool's name.
        tool: String,
    },
    /// A list of grip yaws without an entry.
    #[error("the task has no grip yaw")]
    NoYaw,
}

/// A plan with the rules of its task that it breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct ManualPlan {
    /// The plan.
    pub plan: Plan,
    /// Index of a push and a rule that it breaks; a plan that is searched for breaks none.
    pub broken: Vec<(usize, Infeasible)>,
}

/// The plan of `pushes` with the first of `grip_yaws` (radians) with which they can be made.
///
/// # Errors
/// Why it cannot be made with the first grip yaw. A push that breaks a rule of the task (reach,
/// obstacles) is made all the same: seeing what would happen is the point.
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
    let mut broken = Vec::new();
    let mut state = situation.start.clone();
    for (k, asked) in pushes.iter().enumerate() {
        let previous = plan.push_steps().last().map(|step| step.push.end());
        let (start, pushed) = start(task, (tool, grip_yaw), asked, &state, previous)?;
        let push = Push {
            start,
            direction: asked.direction,
            length: asked.length.unwrap_or(rules.length),
            speed: asked.speed.unwrap_or(rules.speed),
        };
        let set_down = (k == 0 || form == PushForm::Placed).then_some(0.0);
        let tools = std::slice::from_ref(tool);
        let workspace = Workspace { task, tools };
        let rule = workspace.margins((0, grip_yaw), (&state, pushed), &push, set_down).broken();
        broken.extend(rule.map(|rule| (k, rule)));
        let made = Plan::pushing(&tool.name, grip_yaw, form, lift, [push]);
        // Where a chained push starts does not depend on the objects.
        if form == PushForm::Placed && k + 1 < pushes.len() {
            state = after(situation, tool, &made, state);
        }
        plan = plan.then(made);
    }
    Ok(ManualPlan { plan, broken })
}

/// Where a push leaves objects that rest at `start`: to the bit as if all the pushes before had been made
/// with it.
fn after(situation: &Situation, tool: &Arc<Tool>, push: &Plan, start: State) -> State {
    let job = Job { start, ..Job::new(situation, push.motion(tool)) };
    Simulator::planar().run(&situation.scene, &job, Record::Outcome).outcome().clone()
}

/// Returns the start of the push, and the object that it is meant for.
fn start(
    task: &Task,
    (tool, grip_yaw): (&Arc<Tool>, f64),
    asked: &ManualPush,
    state: &State,
    previous: Option<Vector>,
) -> Result<(Vector, usize), ActionError> {
    let goal = task.goals[0].object;
    let chained = task.pushes.form == PushForm::Chained;
    let (object, offset) = match &asked.start {
        ManualStart::At(at) => {
            let elsewhere = |end: Vector| (end - at).norm() > SAME_PLACE;
            let broken = chained && previous.is_some_and(elsewhere);
            return if broken { Err(ActionError::ChainBroken) } else { Ok((*at, goal)) };
        }
        ManualStart::Last if chained => return Ok((previous.unwrap_or(task.robot.home), goal)),
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
            Ok(start) => {
                let push = Push { start, direction, length, speed };
                let margins = workspace.margins((0, grip_yaw), (state, index), &push, Some(0.0));
                if margins.broken().is_none() {
                    return Ok((start, index));
                }
                first.get_or_insert(start);
            }
            Err(infeasible) => why = infeasible,
        }
    }
    let refused =
        || ActionError::CannotPush { tool: tool.name.clone(), object: object.clone(), why };
    first.map(|start| (start, index)).ok_or_else(refused)
}
