//! `pushplan bench tools`: the reference tool benchmark.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;

use crate::{
    error::CliError,
    model::OutOfRangeArgs,
    session::Session,
    solve::solve_error,
    value_enums::{EFFORTS, LAYOUTS, possible_values},
};
use pushplan::asset::write_atomic;
use pushplan::scene::{ModelKind, ModelSpec};
use pushplan::solve::{Effort, Planner, Settings};
use pushplan_bench::store::RunManifest;
use pushplan_bench::{
    GoalSet, Layout, ReferenceSetup, ToolBench, ToolBenchError, ToolRecord, single_pushes,
};
use pushplan_report::{Document, single_document, tools_document};

use super::keep::{self, KeepArgs, value_digest, weights_digest};
use super::suite::{Cases, Measure, Run, Suite, SuiteArgs, only};

/// Run the reference tool benchmark: choose a tool, pushes and a stopping point for each goal
#[derive(Args, Debug)]
#[command(after_help = keep::HELP)]
pub struct ToolsArgs {
    /// Effect model of all rows [default: the network; for the planner, the model of the effort]
    #[arg(long, value_name = "MODEL")]
    model: Option<ModelSpec>,
    #[command(flatten)]
    out_of_range: OutOfRangeArgs,
    /// Start positions of the cylinder
    #[arg(long, value_parser = possible_values(&LAYOUTS), default_value = "grid")]
    layout: Layout,
    /// Pushes of a task
    #[arg(long, value_enum, default_value_t)]
    form: FormName,
    /// Search effort of the planner
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Number of tasks with --form single
    #[arg(long, value_name = "N", default_value_t = 10_000,
          value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    tasks: u32,
    /// Seed of the random choices, and of the tasks with --form single
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Regenerate the goals of the layout, write them to this file, and exit
    #[arg(long, value_name = "FILE")]
    make_goals: Option<PathBuf>,
}

/// Pushes of a task.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum FormName {
    /// Three consecutive pushes from a fixed home position
    #[default]
    Chained,
    /// Single push with random start and goal (the earlier form)
    Single,
}

/// Runs the benchmark, or the single pushes or the generation of goals if selected.
///
/// # Errors
/// Returns the errors of [`SuiteArgs::run`], and errors of writing goals.
pub fn run(args: &SuiteArgs<ToolsArgs>, session: &Session) -> Result<(), CliError> {
    let tools = &args.suite;
    if let Some(file) = &tools.make_goals {
        let setup = ReferenceSetup::new(tools.layout);
        let spinner = session.spinner("simulating");
        let goals = session.compute(|| GoalSet::make(&setup));
        spinner.finish_and_clear();
        write_atomic(file, goals.to_text().as_bytes()).map_err(CliError::Output)?;
        return session.print(&format!("{} goals in {}\n", goals.len(), file.display()));
    }
    if tools.form == FormName::Chained {
        return args.run(session);
    }
    if args.keep.out.is_some() {
        return Err(CliError::usage(
            "single pushes are neither saved nor sharded, because they take only seconds",
            "omit --out or --form single",
        ));
    }
    let model = tools.out_of_range.load(&tools.spec())?;
    let spinner = session.spinner("pushing");
    let report = session.compute(|| single_pushes(&model, tools.seed, tools.tasks as usize));
    spinner.finish_and_clear();
    args.form.show(session, &single_document(&report))
}

impl ToolsArgs {
    /// Returns the model of all rows.
    fn spec(&self) -> ModelSpec {
        self.model.clone().unwrap_or_else(|| ModelKind::NETWORK.into())
    }
}

impl Suite for ToolsArgs {
    const NAME: &'static str = "tools";
    type Record = ToolRecord;

    fn cases<'a>(
        &'a self,
        _: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, ToolRecord>, CliError> {
        let layout = self.layout;
        let setup = ReferenceSetup::new(layout);
        let goals = GoalSet::shipped(layout)
            .map_err(|error| CliError::unexpected("cannot read the shipped goals", &error))?;
        let spec = self.spec();
        let model = self.out_of_range.load(&spec)?;
        let effort = self.effort;
        let planned = self.model.clone().unwrap_or_else(|| effort.model());
        let planner = Planner::with_model(&planned)?
            // Perturbed replays measure the robustness of a plan without affecting its choice.
            .settings(Settings { replays: 0, ..effort.settings() })
            .seed(self.seed)
            .out_of_range(self.out_of_range.out_of_range())
            .build();
        let mut settings = json!({
            "layout": layout,
            "goals": value_digest(&goals)?,
            "planner": format!("effort {effort} with {planned}"),
            "budget": planner.settings(),
        });
        self.out_of_range.note(&mut settings);
        let manifest = RunManifest::new(Self::NAME, goals.len(), self.seed, &spec.to_string())
            .with_weights(weights_digest(&spec)?)
            .with_settings(settings);
        let mut bench = ToolBench::new(setup, goals, model, planner, self.seed);
        let measure = Measure::InTurn(Box::new(move |index| {
            session.compute(|| bench.measure(index)).map_err(|error| match error {
                ToolBenchError::Solve(error) => solve_error(error),
                error @ ToolBenchError::NoTask { .. } => CliError::Unexpected(error.to_string()),
            })
        }));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<ToolRecord>]) -> Result<Document, CliError> {
        only(runs).map(|(manifest, finished)| tools_document(manifest, finished))
    }
}
