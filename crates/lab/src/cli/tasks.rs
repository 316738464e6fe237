//! Random tasks from arguments, and tasks as files.

use std::path::Path;

use clap::Args;
use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::solve::{Effort, Planner};
use pushplan::internals::task::Task;
use pushplan_bench::store::RunManifest;
use pushplan_command::bench::common::Common;
use pushplan_command::bench::keep::{tools_digest, weights_digest};
use pushplan_command::error::CliError;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;
use pushplan_command::{interrupt, output};
use serde_json::json;

use crate::bench::{RandomSuite, TaskKind};

use super::value_enums::KINDS;

/// Random tasks, with models and tools.
#[derive(Args, Debug)]
pub struct TasksArgs {
    #[command(flatten)]
    pub common: Common,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Restrict to tasks of this kind; repeatable [default: all, in turn]
    #[arg(long = "kind", value_parser = possible_values(&KINDS), value_name = "KIND")]
    kinds: Vec<&'static [TaskKind]>,
}

impl TasksArgs {
    /// Returns the tasks, whose kinds alternate in a fixed order.
    pub fn suite(&self, library: &ToolLibrary) -> RandomSuite {
        let mut kinds = self.kinds.concat();
        kinds.sort_unstable();
        kinds.dedup();
        RandomSuite::new(library, self.seed, &kinds)
    }

    /// Returns the settings that determine a run of the suite `name` on the first `count` of these
    /// tasks.
    ///
    /// # Errors
    /// Returns an error if weights cannot be read.
    pub fn manifest(
        &self,
        (name, count): (&str, usize),
        suite: &RandomSuite,
        (effort, planner): (Effort, &Planner),
    ) -> Result<RunManifest, CliError> {
        let model = self.common.model(effort);
        let mut settings = json!({
            "effort": effort,
            "budget": planner.settings(),
            "kinds": suite.kinds(),
            "tasks_version": RandomSuite::VERSION,
            "tools": tools_digest(suite.tools().iter())?,
        });
        self.common.out_of_range.note(&mut settings);
        Ok(RunManifest::new(name, count, self.seed, &model.to_string())
            .with_weights(weights_digest(&model)?)
            .with_settings(settings))
    }
}

/// Writes the tasks of a run as files.
///
/// # Errors
/// Returns an error if a task cannot be made or written, or on an interruption.
pub fn save_tasks(
    folder: &Path,
    session: &Session,
    indices: impl ExactSizeIterator<Item = usize>,
    task: impl Fn(usize) -> Result<Task, CliError>,
) -> Result<(), CliError> {
    output::prepare(folder)?;
    interrupt::watch();
    let bar = session.bar("saving tasks");
    bar.set_length(indices.len() as u64);
    for index in indices {
        if interrupt::requested() {
            return Err(CliError::Interrupted("stopped while saving the tasks".to_owned()));
        }
        let task = task(index)?;
        let text = task.to_yaml().map_err(CliError::Output)?;
        output::write(folder, &format!("{}.yaml", task.name), text.as_bytes())?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}
