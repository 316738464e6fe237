//! Task of a command: a user's file, or a shipped one.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;

use pushplan::asset::{ToolLibrary, load_example, load_task};
use pushplan::task::Task;
use pushplan_report::TaskSource;

use super::error::CliError;

/// Text of `--help` for `--example`.
pub const HELP: &str = "Shipped task to use instead of a file; `pushplan new --help` lists all";

/// Returns a parser of the names of shipped tasks, which errors and the help of `new` list.
pub fn example() -> PossibleValuesParser {
    Task::examples().into()
}

/// Task of a command.
#[derive(Args, Debug)]
#[group(required = true, multiple = false)]
pub struct TaskArgs {
    /// Task file
    task: Option<PathBuf>,
    #[arg(long, value_name = "NAME", help = HELP, hide_possible_values = true,
          value_parser = example())]
    example: Option<String>,
}

impl TaskArgs {
    /// Reads the task, with the tools that it names looked up in `library`.
    pub fn load(&self, library: &ToolLibrary) -> Result<Task, CliError> {
        Ok(match self.source() {
            TaskSource::Example(name) => load_example(&name, library)?,
            TaskSource::File(path) => load_task(path, library)?,
        })
    }

    /// Returns the source of the task.
    pub fn source(&self) -> TaskSource {
        match (&self.example, &self.task) {
            (Some(name), _) => TaskSource::Example(name.clone()),
            (None, path) => TaskSource::of(path.clone().unwrap_or_default()),
        }
    }
}
