//! `pushplan-lab random`: random tasks of several kinds.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::solve::Effort;
use pushplan_bench::SolvedTask;
use pushplan_command::bench::keep;
use pushplan_command::bench::keep::KeepArgs;
use pushplan_command::bench::suite::{Cases, Measure, Run, Suite};
use pushplan_command::error::CliError;
use pushplan_command::session::Session;
use pushplan_command::solve::solve_error;
use pushplan_command::value_enums::{EFFORTS, possible_values};
use pushplan_report::Document;

use crate::bench::{RandomError, RandomRecord};
use crate::cli::kept::same_tasks;
use crate::cli::tasks::{TasksArgs, save_tasks};
use crate::report::random_document;

/// Solve random tasks of several kinds, each known to be solvable
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:
  pushplan-lab random --count 200 --out runs/network
  pushplan-lab random --count 200 --model planar --out runs/planar
  pushplan-lab report runs/network runs/planar --out runs/both
  pushplan-lab random --kind pull --count 5 --save-tasks my-tasks
  pushplan-lab random --kind everyday --count 600 --out runs/everyday

{}", keep::HELP))]
pub struct RandomArgs {
    #[command(flatten)]
    tasks: TasksArgs,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 1000,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// How hard to try
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
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
        let TasksArgs { common, .. } = &self.tasks;
        let library = common.library.load()?;
        let suite = self.tasks.suite(&library);
        let planner = common.planner(self.effort)?.build();
        let count = self.count as usize;
        let manifest = self.tasks.manifest((Self::NAME, count), &suite, (self.effort, &planner))?;
        if let Some(folder) = &self.save_tasks {
            let task = |index| {
                let drawn = session.compute(|| suite.task(index));
                Ok(drawn.map_err(|error| random_error(error.into()))?.task)
            };
            save_tasks(folder, session, keep.indices(count), task)?;
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

    // The seed of a random run is the seed of its tasks; its planner has the default seed.
    fn solved((_, finished): &Run<RandomRecord>) -> Option<(u64, Vec<SolvedTask>)> {
        Some((0, finished.iter().map(|task| task.record.solved.clone()).collect()))
    }
}

pub fn random_error(error: RandomError) -> CliError {
    match error {
        RandomError::NoTask(_) => {
            CliError::usage(error.to_string(), "choose other kinds with --kind, or other tools")
        }
        RandomError::Solve(error) => solve_error(error),
    }
}
