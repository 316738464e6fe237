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
use pushplan::scene::{ModelKind, ModelSpec, Models};
use pushplan::solve::{Effort, Planner, Settings};
use pushplan_bench::store::RunManifest;
use pushplan_bench::{
    GoalSet, Layout, ReferenceSetup, ToolBench, ToolBenchError, ToolRecord, single_pushes,
};
use pushplan_report::{Document, single_document, tools_document};

use super::keep::{self, KeepArgs, value_digest, weights_digest};
use super::suite::{Cases, Measure, Run, Suite, SuiteArgs, only};

/// The reference tool benchmark: choose a tool, pushes and a stop for a goal
#[derive(Args, Debug)]
#[command(after_help = keep::HELP)]
pub struct ToolsArgs {
    /// Effect model of all rows; by default the network, and for the planner that of the effort
    #[arg(long, value_name = "MODEL")]
    model: Option<Models>,
    #[command(flatten)]
    out_of_range: OutOfRangeArgs,
    /// Where the cylinder starts
    #[arg(long, value_parser = possible_values(&LAYOUTS), default_value = "grid")]
    layout: Layout,
    /// The pushes
    #[arg(long, value_enum, default_value_t)]
    form: FormName,
    /// How hard the planner tries
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Number of tasks of single pushes
    #[arg(long, value_name = "N", default_value_t = 10_000,
          value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    tasks: u32,
    /// Seed of the random choices, and of the tasks of single pushes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Make the goals of the layout again, write them to this file, and stop
    #[arg(long, value_name = "FILE")]
    make_goals: Option<PathBuf>,
}

/// The pushes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum FormName {
    /// Three one after another from a fixed home
    #[default]
    Chained,
    /// One, with start and goal at random (the earlier form)
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
            "single pushes take seconds; they are neither kept nor sharded",
            "leave --out out, or --form single",
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
        self.model.clone().map_or(ModelKind::NETWORK.into(), |models| models.decided)
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
            .map_err(|error| CliError::unexpected("the shipped goals are broken", &error))?;
        let spec = self.spec();
        let model = self.out_of_range.load(&spec)?;
        let effort = self.effort;
        let models = self.model.clone().unwrap_or_else(|| effort.models());
        let planner = Planner::with_models(&models)?
            // Perturbed replays measure the robustness of a plan without affecting its choice.
            .settings(Settings { replays: 0, ..effort.settings() })
            .seed(self.seed)
            .out_of_range(self.out_of_range.out_of_range())
            .build();
        let mut settings = json!({
            "layout": layout,
            "goals": value_digest(&goals)?,
            "planner": format!("effort {effort} with {}", planner.models()),
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
