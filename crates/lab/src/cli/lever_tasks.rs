//! `pushplan-lab lever-tasks`: generated levering tasks.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::scene::{ModelKind, ModelSpec};
use pushplan::internals::solve::{Effort, Planner};
use pushplan_bench::store::RunManifest;
use pushplan_command::action::LibraryArgs;
use pushplan_command::bench::keep;
use pushplan_command::bench::keep::{KeepArgs, tools_digest, weights_digest};
use pushplan_command::bench::suite::{Cases, Measure, Run, Suite, only};
use pushplan_command::error::CliError;
use pushplan_command::model;
use pushplan_command::session::Session;
use pushplan_command::solve::solve_error;
use pushplan_command::value_enums::{EFFORTS, possible_values};
use pushplan_report::Document;
use serde_json::json;

use crate::bench::{LeverRecord, LeverSuite};
use crate::cli::tasks::save_tasks;
use crate::report::lever_tasks_document;

/// Solve generated levering tasks: lift a circuit board out of a hard drive
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:
  pushplan-lab lever-tasks --count 50
  pushplan-lab lever-tasks --count 5 --save-tasks my-tasks

{}", keep::HELP))]
pub struct LeverTasksArgs {
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 50,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Search effort
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
    effort: Effort,
    #[arg(long, value_name = "MODEL", help = model::HELP_FOR_LEVERS)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Also write the task files to this folder, for `pushplan solve`
    #[arg(long, value_name = "DIR")]
    save_tasks: Option<PathBuf>,
}

impl Suite for LeverTasksArgs {
    const NAME: &'static str = "lever-tasks";
    type Record = LeverRecord;

    fn cases<'a>(
        &'a self,
        keep: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, LeverRecord>, CliError> {
        let library = self.library.load()?;
        let count = self.count as usize;
        let suite = LeverSuite::new(self.seed, count);
        let spec = self.model.clone().unwrap_or(ModelKind::PRIOR.into());
        let planner = Planner::builder(model::load(&spec)?).effort(self.effort).build();
        let settings = json!({
            "effort": self.effort,
            "budget": planner.settings().levers,
            "tasks_version": LeverSuite::VERSION,
            "tools": tools_digest(library.blades().iter())?,
        });
        let manifest = RunManifest::new(Self::NAME, count, self.seed, &spec.to_string())
            .with_weights(weights_digest(&spec)?)
            .with_settings(settings);
        if let Some(folder) = &self.save_tasks {
            save_tasks(folder, session, keep.indices(count), |index| Ok(suite.task(index)))?;
        }
        let measure = Measure::InTurn(Box::new(move |index| {
            session.compute(|| suite.measure(&planner, &library, index)).map_err(solve_error)
        }));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<LeverRecord>]) -> Result<Document, CliError> {
        only(runs).map(|(manifest, finished)| lever_tasks_document(manifest, finished))
    }
}
