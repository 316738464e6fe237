//! `pushplan bench tasks`: task files solved one after another.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::{
    error::CliError,
    session::Session,
    solve::solve_error,
    value_enums::{EFFORTS, possible_values},
};
use pushplan::asset::load_task;
use pushplan::solve::Effort;
use pushplan::task::Task;
use pushplan_bench::SolvedTask;
use pushplan_bench::store::{Measured, RunManifest};
use pushplan_report::{Document, solved_document};

use super::common::Common;
use super::keep::{self, KeepArgs, tools_digest, value_digest, weights_digest};
use super::suite::{Cases, Measure, Run, Suite, only};

/// Solve task files in sequence, and report success, error and time of each
#[derive(Args, Debug)]
#[command(after_help = keep::HELP)]
pub struct TasksArgs {
    #[command(flatten)]
    common: Common,
    /// Task files
    #[arg(required = true, value_name = "TASK")]
    tasks: Vec<PathBuf>,
    /// Search effort
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Seed of the refinement samples and the perturbed replays
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
}

impl Suite for TasksArgs {
    const NAME: &'static str = "tasks";
    type Record = SolvedTask;

    fn cases<'a>(
        &'a self,
        _: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, SolvedTask>, CliError> {
        let library = self.common.library.load()?;
        let tasks = self
            .tasks
            .iter()
            .map(|file| Ok(load_task(file, &library)?))
            .collect::<Result<Vec<Task>, CliError>>()?;
        let model = self.common.model(self.effort);
        let planner = self.common.planner(self.effort)?.seed(self.seed).build();
        let mut settings = json!({
            "budget": planner.settings(),
            "tools": tools_digest(library.iter())?,
            "files": tasks.iter().map(|task| &task.name).collect::<Vec<_>>(),
            "content": value_digest(&tasks)?,
        });
        self.common.out_of_range.note(&mut settings);
        let manifest = RunManifest::new(Self::NAME, tasks.len(), self.seed, &model.to_string())
            .with_weights(weights_digest(&model)?)
            .with_settings(settings);
        let measure = Measure::InTurn(Box::new(move |index| {
            let task = &tasks[index];
            session.compute(|| {
                let solution = planner.solve(task, &library).map_err(solve_error)?;
                let record = SolvedTask::of(task, &solution);
                Ok(Measured { record, seconds: SolvedTask::seconds(&solution) })
            })
        }));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<SolvedTask>]) -> Result<Document, CliError> {
        only(runs).map(|(manifest, finished)| solved_document(manifest, finished))
    }

    fn solved((manifest, finished): &Run<SolvedTask>) -> Option<(u64, Vec<SolvedTask>)> {
        Some((manifest.seed, finished.iter().map(|task| task.record.clone()).collect()))
    }
}
