//! Actions from the command line: conversion of a task, a tool and pushes to a tool motion.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;

use pushplan::asset::ToolLibrary;
use pushplan::solve::{ActionError, ManualLever, ManualPush, manual_lever, manual_plan};
use pushplan::{
    scene::{ModelSpec, Situation, Tool},
    task::{Plan, Task},
};
use pushplan_report::{Origin, TaskSource};

use super::{
    error::CliError, lever_argument::lever_argument, push_argument::push_argument, session::Session,
};

/// Sources of tools.
#[derive(Args, Debug)]
pub struct LibraryArgs {
    /// Folder of tool files that replace the built-in tools
    #[arg(long, value_name = "DIR")]
    tools: Option<PathBuf>,
    /// Folder of additional tool files; they replace built-in tools of the same names
    #[arg(long, value_name = "DIR")]
    more_tools: Option<PathBuf>,
}

impl LibraryArgs {
    /// Reads the tools.
    pub fn load(&self) -> Result<ToolLibrary, CliError> {
        let library = match &self.tools {
            Some(folder) => ToolLibrary::load(folder)?,
            None => ToolLibrary::embedded()?,
        };
        Ok(match &self.more_tools {
            Some(folder) => library.with_folder(folder)?,
            None => library,
        })
    }

    /// Returns the sources of a page: these tools, the task and, if given, the model.
    pub fn origin(&self, task: TaskSource, model: Option<ModelSpec>) -> Origin {
        let shown = |folder: &PathBuf| folder.display().to_string();
        Origin {
            task,
            tools: self.tools.as_ref().map(shown),
            more_tools: self.more_tools.as_ref().map(shown),
            model,
        }
    }
}

/// Manual action.
#[derive(Args, Debug)]
pub struct ActionArgs {
    /// Name of the tool; the task's `tools` need not list it
    #[arg(long, value_name = "NAME", requires = "moves")]
    tool: Option<String>,
    /// Push to make, see below; repeat the option for several pushes in order
    #[arg(long = "push", value_name = "PUSH", requires = "tool", allow_hyphen_values = true,
          value_parser = push_argument, group = "moves")]
    pushes: Vec<ManualPush>,
    /// Lever-up of a levering task, see below; without --tool, the first tool of the task is used
    #[arg(long, value_name = "LEVER", conflicts_with_all = ["pushes", "grip_yaw_deg"],
          allow_hyphen_values = true, value_parser = lever_argument, group = "moves")]
    lever: Option<ManualLever>,
    /// Rotation of the end effector from +x, degrees [default: the first possible grip yaw of the
    /// task]
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    grip_yaw_deg: Option<f64>,
}

impl ActionArgs {
    /// Returns `true` if an action was given.
    pub fn given(&self) -> bool {
        self.tool.is_some() || self.lever.is_some()
    }

    /// Returns the action as a plan, with its tool. Violated rules of the task are reported as
    /// warnings.
    ///
    /// # Errors
    /// Returns [`CliError::Usage`] if the arguments give no valid plan.
    pub fn plan(
        &self,
        task: &Task,
        library: &ToolLibrary,
        session: &Session,
    ) -> Result<(Plan, Arc<Tool>), CliError> {
        if let Some(lever) = &self.lever {
            return self.levering(task, library, lever, session);
        }
        if task.levers.is_some() && (self.tool.is_none() || task.pushes.max_count == 0) {
            let advice = "add --lever point=0:0.5,depth=0.012,angle=90, see --help";
            let message = match self.pushes.is_empty() {
                true => "this is a levering task, but no lever-up is given",
                false => "this is a levering task, not a pushing task",
            };
            return Err(CliError::usage(message, advice));
        }
        let name = self.tool.as_deref().ok_or_else(|| {
            CliError::usage("no action is given", "add --tool and --push, see --help")
        })?;
        let tool = library
            .get(name)
            .filter(|tool| tool.pushes())
            .ok_or_else(|| unknown_tool(name, "tool", library.iter()))?;
        let yaws = match self.grip_yaw_deg {
            Some(yaw) if yaw.is_finite() => vec![yaw.to_radians()],
            Some(_) => return Err(CliError::usage("--grip-yaw-deg must be finite", "try 90")),
            None => task.pushes.grip_yaws.clone(),
        };
        let situation = Situation::stated(&task.scene);
        let asked = session
            .compute(|| manual_plan(task, &situation, tool, &yaws, &self.pushes))
            .map_err(|error| refused(&error, task))?;
        for (push, rule) in &asked.violations {
            session.warn(&format!("push {}: {rule}; no plan would contain this push", push + 1));
        }
        Ok((asked.plan, Arc::clone(tool)))
    }

    /// Returns a lever-up as a plan, with its tool: the named one, otherwise the first of the task.
    fn levering(
        &self,
        task: &Task,
        library: &ToolLibrary,
        lever: &ManualLever,
        session: &Session,
    ) -> Result<(Plan, Arc<Tool>), CliError> {
        if task.levers.is_none() {
            let advice = "add --tool and --push, or choose a levering task";
            return Err(CliError::usage("this is a pushing task, not a levering task", advice));
        }
        let tool = match &self.tool {
            Some(name) => {
                let found = library.get(name).filter(|tool| tool.blade().is_some());
                let blades = library.blades().iter();
                Arc::clone(found.ok_or_else(|| unknown_tool(name, "tool with a blade", blades))?)
            }
            None => task.blades(library)?.remove(0),
        };
        let (plan, violation) = manual_lever(task, &tool, lever).map_err(|error| {
            let advice = "edge 0 runs from the first corner to the second, counter-clockwise; on a \
                          cuboid it is the edge at the smallest y";
            CliError::usage(error.to_string(), advice)
        })?;
        if let Some(rule) = &violation {
            session.warn(&format!("{rule}; no plan would contain this lever-up"));
        }
        Ok((plan, tool))
    }
}

fn refused(error: &ActionError, task: &Task) -> CliError {
    let advice = match error {
        ActionError::ChainBroken => "omit `start` after the first push".to_owned(),
        ActionError::Chained => "write direction_deg=.. length=..".to_owned(),
        ActionError::NoStart => "write start=x,y, or use the form OBJECT:DIRECTION_DEG".to_owned(),
        ActionError::NoObject { .. } => {
            let names: Vec<&str> = task.scene.things().map(|(_, o)| o.name.as_str()).collect();
            format!("use {}", names.join(", "))
        }
        ActionError::CannotPush { .. } => {
            "try another direction, offset or grip yaw, or give the start".to_owned()
        }
        ActionError::Blade { .. } => "name a tool that pushes".to_owned(),
        ActionError::NoYaw => "add `grip_yaws_deg`".to_owned(),
    };
    CliError::usage(error.to_string(), advice)
}

fn unknown_tool<'a>(
    name: &str,
    what: &str,
    known: impl Iterator<Item = &'a Arc<Tool>>,
) -> CliError {
    let names: Vec<&str> = known.map(|tool| tool.name.as_str()).collect();
    CliError::usage(format!("no {what} is called `{name}`"), format!("use {}", names.join(", ")))
}
