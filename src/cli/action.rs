//! One action from the command line: a task, a tool and pushes become a tool motion.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;

use crate::asset::ToolLibrary;
use crate::effect::{EffectModel, Job, Simulated};
use crate::geometry::Vector;
use crate::plan::{CandidatePush, Start, Workspace};
use crate::scene::{Plan, Push, PushForm, Record, State, Task, Tool};
use crate::sim::Simulator;

use super::{
    error::CliError,
    push_argument::{PushArgument, StartArgument},
    session::Session,
};

/// Where tools come from.
#[derive(Args, Debug)]
pub struct LibraryArgs {
    /// Folder of tool files to choose from instead of the built-in tools
    #[arg(long, value_name = "DIR")]
    tools: Option<PathBuf>,
}

impl LibraryArgs {
    /// Reads the tools.
    pub fn load(&self) -> Result<ToolLibrary, CliError> {
        Ok(match &self.tools {
            Some(folder) => ToolLibrary::load(folder)?,
            None => ToolLibrary::embedded()?,
        })
    }
}

/// One action.
#[derive(Args, Debug)]
pub struct ActionArgs {
    /// Name of the tool; it need not be among the task's
    #[arg(long, value_name = "NAME", requires = "pushes")]
    tool: Option<String>,
    /// A push, or several in order; see below
    #[arg(long = "push", value_name = "PUSH", requires = "tool", allow_hyphen_values = true)]
    pushes: Vec<PushArgument>,
    /// Turn of the end effector against +x; by default the first of the task's that fits
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    grip_yaw_deg: Option<f64>,
}

impl ActionArgs {
    /// Whether an action was given at all.
    pub fn given(&self) -> bool {
        self.tool.is_some()
    }

    /// The action as a plan, with the tool that it names. What breaks a rule of the task (reach,
    /// obstacles) is made all the same, with a warning: seeing what would happen is the point.
    pub fn plan(
        &self,
        task: &Task,
        library: &ToolLibrary,
        session: &Session,
    ) -> Result<(Plan, Arc<Tool>), CliError> {
        let name = self.tool.as_deref().ok_or_else(|| {
            CliError::usage("no action is given", "add --tool and --push, see --help")
        })?;
        let tool = library.get(name).ok_or_else(|| unknown_tool(name, library))?;
        let yaws = match self.grip_yaw_deg {
            Some(yaw) if yaw.is_finite() => vec![yaw.to_radians()],
            Some(_) => return Err(CliError::usage("--grip-yaw-deg must be finite", "try 90")),
            None => task.pushes.grip_yaws.clone(),
        };
        let mut refused = None;
        for grip_yaw in yaws {
            match self.with_yaw(task, tool, grip_yaw, session) {
                Ok(plan) => return Ok((plan, Arc::clone(tool))),
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        Err(refused.unwrap_or_else(|| CliError::usage("the task has no grip yaw", "add one")))
    }

    fn with_yaw(
        &self,
        task: &Task,
        tool: &Arc<Tool>,
        grip_yaw: f64,
        session: &Session,
    ) -> Result<Plan, CliError> {
        let rules = &task.pushes;
        let (form, lift) = (rules.form, rules.lift);
        let mut plan = Plan { tool: tool.name.clone(), grip_yaw, form, lift, pushes: Vec::new() };
        for (k, argument) in self.pushes.iter().enumerate() {
            let state = after(task, tool, &plan, session);
            let previous = plan.pushes.last().map(Push::end);
            let start = start(task, tool, grip_yaw, argument, &state, previous)?;
            let push = Push {
                start,
                direction: argument.direction,
                length: argument.length.unwrap_or(rules.length),
                speed: argument.speed.unwrap_or(rules.speed),
            };
            let set_down = k == 0 || form == PushForm::Placed;
            let tools = std::slice::from_ref(tool);
            let workspace = Workspace { task, tools, later_stand_off: 0.0 };
            if let Some(rule) = workspace.margins((0, grip_yaw), &state, &push, set_down).broken() {
                session.warn(&format!("push {}: {rule}; a plan would not contain it", k + 1));
            }
            plan.pushes.push(push);
        }
        Ok(plan)
    }
}

/// Where the pushes so far leave the objects: later placed pushes are placed there.
fn after(task: &Task, tool: &Arc<Tool>, plan: &Plan, session: &Session) -> State {
    if plan.pushes.is_empty() {
        return task.scene.start();
    }
    let job = Job::stated(&task.scene, plan.motion(tool));
    let model = Simulated::new(Simulator::planar());
    let found = session.compute(|| model.rollout(&task.scene, &[job], Record::Outcome));
    found.first().map_or_else(|| task.scene.start(), |trajectory| trajectory.outcome().clone())
}

fn start(
    task: &Task,
    tool: &Arc<Tool>,
    grip_yaw: f64,
    argument: &PushArgument,
    state: &State,
    previous: Option<Vector>,
) -> Result<Vector, CliError> {
    let chained = task.pushes.form == PushForm::Chained;
    let (object, offset) = match &argument.start {
        StartArgument::At(at) => {
            if chained && previous.is_some_and(|end| (end - at).norm() > 1e-6) {
                return Err(CliError::usage(
                    "chained pushes go on where the last one ended",
                    "leave the start out after the first push",
                ));
            }
            return Ok(*at);
        }
        StartArgument::Last => {
            if chained {
                return Ok(previous.unwrap_or(task.robot.home));
            }
            return Err(CliError::usage(
                "a push of this task needs a start",
                "write start=x,y, or use the form OBJECT:DIRECTION_DEG",
            ));
        }
        StartArgument::Before { .. } if chained => {
            return Err(CliError::usage(
                "the pushes of this task are chained: the first starts at home",
                "write direction_deg=.. length=..",
            ));
        }
        StartArgument::Before { object, offset } => (object, *offset),
    };
    let index = task.scene.object(object).ok_or_else(|| {
        let names: Vec<&str> = task.scene.objects.iter().map(|o| o.name.as_str()).collect();
        CliError::usage(
            format!("no object is called `{object}`"),
            format!("use {}", names.join(", ")),
        )
    })?;
    let mut of_object = task.clone();
    of_object.goal.object = index;
    let tools = std::slice::from_ref(tool);
    let workspace = Workspace { task: &of_object, tools, later_stand_off: 0.0 };
    let length = argument.length.unwrap_or(task.pushes.length);
    let mut refused = None;
    for part in 0..tool.parts.len() {
        let start = Start::Placed { part, offset };
        let push = CandidatePush { start, direction: argument.direction, length };
        match workspace.place((0, grip_yaw), state, &push, 0, previous) {
            Ok(start) => return Ok(start),
            Err(why) => refused = Some(why),
        }
    }
    let why = refused.map_or_else(String::new, |why| format!(": {why}"));
    Err(CliError::usage(
        format!("`{}` cannot push `{object}` that way{why}", tool.name),
        "try another direction, offset or grip yaw, or give the start",
    ))
}

fn unknown_tool(name: &str, library: &ToolLibrary) -> CliError {
    let names: Vec<&str> = library.iter().map(|tool| tool.name.as_str()).collect();
    CliError::usage(format!("no tool is called `{name}`"), format!("use {}", names.join(", ")))
}
