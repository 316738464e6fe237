//! `pushplan bench tools`: the reference tool benchmark.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

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
    GoalSet, Layout, ReferenceSetup, ToolBench, ToolBenchError, ToolForm, ToolRecord,
};
use pushplan_report::{Document, tools_document};

use super::keep::{self, KeepArgs, value_digest, weights_digest};
use super::suite::{Cases, Measure, Run, Suite, SuiteArgs, only};

/// Number of tasks by default, which takes less than two minutes on one thread.
const TASKS: usize = 16;

/// Duration of runs, before the section on saved benchmarks.
const DURATION: &str = "A chained task takes about 6 seconds on one thread, and the default of 16 \
tasks less than 2 minutes; a single push takes 1 second. All goals of a layout, --tasks all, take \
about 10 minutes.";

/// Run the reference tool benchmark: choose a tool, pushes and a stopping point for each goal
#[derive(Args, Debug)]
#[command(after_help = format!("{DURATION}\n\n{}", keep::HELP))]
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
    /// Number of tasks: chained goals spread evenly over the layout, or `all` of them
    #[arg(long, value_name = "N", default_value_t = Count::Some(TASKS))]
    tasks: Count,
    /// Seed of the random choices, and of the goals with --form single
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Generate the goals again, write them to this file, and exit; of a layout always all
    #[arg(long, value_name = "FILE")]
    make_goals: Option<PathBuf>,
}

/// Pushes of a task.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum FormName {
    /// Up to three consecutive pushes from a fixed home position
    #[default]
    Chained,
    /// Single push from the home position; random starts, each with a goal that some push reaches
    Single,
}

/// Number of tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Count {
    /// Stated number.
    Some(usize),
    /// Number of goals of a layout.
    All,
}

/// Largest number of tasks.
const MOST: usize = 1_000_000;

impl FromStr for Count {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse()) {
            ("all", _) => Ok(Self::All),
            (_, Ok(count @ 1..=MOST)) => Ok(Self::Some(count)),
            _ => Err(format!("expected `all` or a number from 1 to {MOST}")),
        }
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Some(count) => count.fmt(f),
            Self::All => f.write_str("all"),
        }
    }
}

/// Runs the benchmark, or generates goals if selected.
///
/// # Errors
/// Returns the errors of [`SuiteArgs::run`], and errors of writing goals.
pub fn run(args: &SuiteArgs<ToolsArgs>, session: &Session) -> Result<(), CliError> {
    let tools = &args.suite;
    let Some(file) = &tools.make_goals else { return args.run(session) };
    let setup = tools.setup();
    let spinner = session.spinner("simulating");
    let goals = match tools.form {
        FormName::Chained => Ok(session.compute(|| GoalSet::make(&setup))),
        FormName::Single => tools.goals(&setup, session),
    };
    spinner.finish_and_clear();
    let goals = goals?;
    write_atomic(file, goals.to_text().as_bytes()).map_err(CliError::Output)?;
    session.print(&format!("{} goals in {}\n", goals.len(), file.display()))
}

impl ToolsArgs {
    /// Returns the model of all rows.
    fn spec(&self) -> ModelSpec {
        self.model.clone().unwrap_or_else(|| ModelKind::NETWORK.into())
    }

    /// Returns tools, starts and form of pushes.
    fn setup(&self) -> ReferenceSetup {
        ReferenceSetup::new(self.layout).with_form(match self.form {
            FormName::Chained => ToolForm::Chained,
            FormName::Single => ToolForm::Single,
        })
    }

    /// Returns the goals: shipped ones of the layout, or drawn ones for single pushes.
    fn goals(&self, setup: &ReferenceSetup, session: &Session) -> Result<GoalSet, CliError> {
        match (self.form, self.tasks) {
            (FormName::Chained, count) => {
                let goals = GoalSet::shipped(self.layout).map_err(|error| {
                    CliError::unexpected("cannot read the shipped goals", &error)
                })?;
                match count {
                    Count::All => Ok(goals),
                    Count::Some(count) if count <= goals.len() => Ok(goals.evenly(count)),
                    Count::Some(count) => Err(CliError::usage(
                        format!("this layout has {} goals, not {count}", goals.len()),
                        "use --tasks all",
                    )),
                }
            }
            (FormName::Single, Count::Some(count)) => {
                Ok(session.compute(|| GoalSet::single(setup, self.seed, count)))
            }
            (FormName::Single, Count::All) => Err(CliError::usage(
                "single pushes are drawn at random without end",
                "give their number: --tasks 16",
            )),
        }
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
        let setup = self.setup();
        let goals = self.goals(&setup, session)?;
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
            "form": setup.form,
            "layout": self.layout,
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
