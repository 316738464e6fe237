//! `pushplan-lab random`: random tasks of several kinds.

use std::path::{Path, PathBuf};

use clap::Args;
use pushplan::cli::bench::common::Common;
use pushplan::cli::bench::keep;
use pushplan::cli::bench::keep::{KeepArgs, value_digest, weights_digest};
use pushplan::cli::bench::suite::{Cases, Measure, Run, Suite};
use pushplan::cli::error::CliError;
use pushplan::cli::session::Session;
use pushplan::cli::solve::solve_error;
use pushplan::cli::words::{EFFORTS, words};
use pushplan::cli::{interrupt, model, output};
use pushplan::internals::bench::SolvedTask;
use pushplan::internals::report::Document;
use pushplan::internals::solve::{Effort, Planner};
use pushplan::internals::store::RunManifest;
use serde_json::json;

use crate::bench::{RandomError, RandomRecord, RandomSuite, TaskKind};
use crate::cli::kept::same_tasks;
use crate::cli::words::KINDS;
use crate::report::random_document;

/// Solve random tasks of several kinds, each known to be solvable
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:
  pushplan-lab random --count 200 --out runs/network
  pushplan-lab random --count 200 --model planar --out runs/planar
  pushplan-lab report runs/network runs/planar --out runs/both
  pushplan-lab random --kind pull --count 5 --save-tasks my-tasks

{}", keep::HELP))]
pub struct RandomArgs {
    #[command(flatten)]
    common: Common,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 1000,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Only tasks of this kind; may be given several times [default: all, in turn]
    #[arg(long = "kind", value_parser = words(&KINDS), value_name = "KIND")]
    kinds: Vec<TaskKind>,
    /// How hard to try
    #[arg(long, value_parser = words(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Also write the tasks to this folder, for `pushplan solve`
    #[arg(long, value_name = "DIR")]
    save_tasks: Option<PathBuf>,
}

impl Suite for RandomArgs {
    const NAME: &'static str = "random";
    type Record = RandomRecord;

    fn cases<'a>(
        &'a self,
        keep: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, RandomRecord>, CliError> {
        let library = self.common.library.load()?;
        let mut kinds: Vec<TaskKind> = self.kinds.clone();
        kinds.sort_unstable();
        kinds.dedup();
        let suite = RandomSuite::new(&library, self.seed, &kinds);
        let effort = self.effort;
        let spec = self.common.spec(effort);
        let planner = Planner::builder(model::load(&spec)?)
            .effort(effort)
            .outside(self.common.outside.outside())
            .build();
        let count = self.count as usize;
        let tools: Vec<_> = library.iter().map(|tool| &**tool).collect();
        let mut settings = json!({
            "effort": effort,
            "budget": planner.settings(),
            "kinds": suite.kinds(),
            "tasks_version": RandomSuite::VERSION,
            "tools": value_digest(&tools)?,
        });
        self.common.outside.note(&mut settings);
        let manifest = RunManifest::new(Self::NAME, count, self.seed, &spec.to_string())
            .with_weights(weights_digest(&spec)?)
            .with_settings(settings);
        if let Some(folder) = &self.save_tasks {
            save_tasks(folder, &suite, keep.indices(count), session)?;
        }
        let measure = Measure::InTurn(Box::new(move |index| {
            session.compute(|| suite.measure(&planner, &library, index)).map_err(random_error)
        }));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<RandomRecord>]) -> Result<Document, CliError> {
        same_tasks(runs)?;
        Ok(random_document(runs))
    }

    // The seed of a random run is that of its tasks; its planner has the default one.
    fn solved((_, finished): &Run<RandomRecord>) -> Option<(u64, Vec<SolvedTask>)> {
        Some((0, finished.iter().map(|task| task.record.solved.clone()).collect()))
    }
}

/// Writes the tasks of a run as files.
fn save_tasks(
    folder: &Path,
    suite: &RandomSuite,
    indices: impl ExactSizeIterator<Item = usize>,
    session: &Session,
) -> Result<(), CliError> {
    output::prepare(folder)?;
    interrupt::watch();
    let bar = session.bar("saving tasks");
    bar.set_length(indices.len() as u64);
    for index in indices {
        if interrupt::requested() {
            return Err(CliError::Interrupted("stopped while saving the tasks".to_owned()));
        }
        let task = session.compute(|| suite.task(index));
        let task = task.map_err(|error| random_error(error.into()))?.task;
        let text = task.to_yaml().map_err(CliError::Output)?;
        output::write(folder, &format!("{}.yaml", task.name), text.as_bytes())?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

pub fn random_error(error: RandomError) -> CliError {
    match error {
        RandomError::NoTask(_) => {
            CliError::usage(error.to_string(), "choose other kinds with --kind, or other tools")
        }
        RandomError::Solve(error) => solve_error(error),
    }
}
