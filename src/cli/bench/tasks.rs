//! `pushplan bench tasks`: task files solved one after another.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::asset::load_task;
use crate::bench::SolvedTask;
use crate::cli::{
    error::CliError,
    model,
    session::Session,
    solve::solve_error,
    words::{EFFORTS, words},
};
use crate::report::solved_document;
use crate::scene::Task;
use crate::solve::{Effort, Planner};
use crate::store::{Measured, RunManifest};

use super::common::Common;
use super::keep::{self, KeepArgs, value_digest, weights_digest};

/// Name of the suite in manifests.
pub const SUITE: &str = "tasks";

/// Solve task files one after another: success, errors and time of each
#[derive(Args, Debug)]
#[command(after_help = keep::HELP)]
pub struct TasksArgs {
    #[command(flatten)]
    common: Common,
    /// The task files
    #[arg(required = true, value_name = "TASK")]
    tasks: Vec<PathBuf>,
    /// How hard to try
    #[arg(long, value_parser = words(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Seed of refinement's samples and of the disturbed replays
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    keep: KeepArgs,
}

pub fn run(args: &TasksArgs, session: &Session) -> Result<(), CliError> {
    let library = args.common.library.load()?;
    let tasks = args
        .tasks
        .iter()
        .map(|file| Ok(load_task(file, &library)?))
        .collect::<Result<Vec<Task>, CliError>>()?;
    let spec = args.common.spec(args.effort);
    let planner = Planner::builder(model::load(&spec)?)
        .effort(args.effort)
        .seed(args.seed)
        .outside(args.common.outside.outside())
        .build();
    let tools: Vec<_> = library.iter().map(|tool| &**tool).collect();
    let mut settings = json!({
        "budget": planner.settings(),
        "tools": value_digest(&tools)?,
        "files": tasks.iter().map(|task| &task.name).collect::<Vec<_>>(),
        "content": value_digest(&tasks)?,
    });
    args.common.outside.note(&mut settings);
    let manifest = RunManifest::new(SUITE, tasks.len(), args.seed, &spec.to_string())
        .with_weights(weights_digest(&spec)?)
        .with_settings(settings);
    let store = args.keep.measure(session, manifest, |index| {
        let task = &tasks[index];
        session.compute(|| {
            let solution = planner.solve(task, &library).map_err(solve_error)?;
            let record = SolvedTask::of(task, &solution);
            Ok(Measured { record, seconds: SolvedTask::seconds(&solution) })
        })
    })?;
    let document = solved_document(store.manifest(), store.finished());
    keep::show(args.common.form, session, &document, args.keep.out.as_deref())
}
