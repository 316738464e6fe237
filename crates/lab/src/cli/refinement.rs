//! `pushplan-lab refinement`: benefit of refinement.

use clap::Args;
use pushplan::internals::solve::{Effort, Planner, Settings};
use pushplan_bench::store::RunManifest;
use pushplan_command::bench::common::Common;
use pushplan_command::bench::keep;
use pushplan_command::bench::keep::{KeepArgs, tools_digest, weights_digest};
use pushplan_command::bench::suite::{Cases, Measure, Run, Suite, only};
use pushplan_command::error::CliError;
use pushplan_command::session::Session;
use pushplan_command::solve::solve_error;
use pushplan_command::value_enums::{EFFORTS, possible_values};
use pushplan_report::Document;
use serde_json::json;

use crate::bench::{RefinedTask, RefinementReport, refine_task};
use crate::report::refinement_document;

/// Solve random solvable tasks with and without refinement of the search results
#[derive(Args, Debug)]
#[command(after_help = keep::HELP)]
pub struct RefinementArgs {
    #[command(flatten)]
    common: Common,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    tasks: u32,
    /// Search effort, apart from refinement
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
}

impl Suite for RefinementArgs {
    const NAME: &'static str = "refinement";
    type Record = RefinedTask;

    fn cases<'a>(
        &'a self,
        _: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, RefinedTask>, CliError> {
        let library = self.common.library.load()?;
        let effort = self.effort;
        let model = self.common.model(effort);
        let budget = Settings { replays: 0, ..effort.settings() };
        let planner = |settings| -> Result<Planner, CliError> {
            Ok(self.common.planner(effort)?.settings(settings).build())
        };
        let without = planner(Settings { refine_rounds: 0, ..budget })?;
        let with = planner(budget)?;
        // Without a tool no task can be made.
        let count = if library.iter().next().is_none() { 0 } else { self.tasks as usize };
        let mut settings = json!({
            "effort": effort,
            "budget": with.settings(),
            "tools": tools_digest(library.iter())?,
        });
        self.common.out_of_range.note(&mut settings);
        let manifest = RunManifest::new(Self::NAME, count, self.seed, &model.to_string())
            .with_weights(weights_digest(&model)?)
            .with_settings(settings);
        let measure = Measure::InTurn(Box::new(move |index| {
            session
                .compute(|| refine_task([&without, &with], &library, self.seed, index))
                .map_err(solve_error)
        }));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<RefinedTask>]) -> Result<Document, CliError> {
        let (run, finished) = only(runs)?;
        let done: Vec<&RefinedTask> = finished.iter().map(|one| &one.record).collect();
        let effort = run.settings["effort"].as_str().unwrap_or("unknown");
        Ok(refinement_document(&RefinementReport::of(&run.model, run.seed, &done), effort))
    }
}
