//! `pushplan bench`: what solving brings and costs.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use serde::Serialize;
use serde_json::json;

use crate::asset::{SCHEMA_VERSION, load_task};
use crate::bench::{
    Suite, SuiteKind, crowd_cases, inference_costs, push_costs, refinement_report, search_costs,
};
use crate::effect::EffectModel;
use crate::report::{
    Table, inference_table, push_cost_table, refinement_table, search_cost_table, solution_json,
    task_table,
};
use crate::scene::Task;
use crate::solve::{Effort, Planner, Solution};

use super::{
    action::LibraryArgs,
    error::CliError,
    exit_code,
    model::{self, ModelName},
    session::Session,
    solve::{EffortName, solve_error},
};

/// Measure what refinement brings and what pushes and searches cost
#[derive(Args, Debug)]
pub struct BenchArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Tasks(TasksArgs),
    Refinement(RefinementArgs),
    Cost(CostArgs),
}

/// What every benchmark takes.
#[derive(Args, Debug)]
struct Common {
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelName,
    #[command(flatten)]
    library: LibraryArgs,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Print Markdown tables
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
}

/// Solve task files one after another: success, errors and time of each
#[derive(Args, Debug)]
struct TasksArgs {
    #[command(flatten)]
    common: Common,
    /// The task files
    #[arg(required = true, value_name = "TASK")]
    tasks: Vec<PathBuf>,
    /// How hard to try
    #[arg(long, value_enum, default_value_t)]
    effort: EffortName,
    /// Seed of refinement's samples and of the disturbed replays
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
}

/// Final errors of plans before and after refinement, over random solvable tasks
#[derive(Args, Debug)]
struct RefinementArgs {
    #[command(flatten)]
    common: Common,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    tasks: u32,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
}

/// Time of one push by every model, and of a search of one-push candidates
#[derive(Args, Debug)]
struct CostArgs {
    #[command(flatten)]
    common: Common,
    /// The task that is searched
    #[arg(value_name = "TASK", required_unless_present = "crowd")]
    task: Option<PathBuf>,
    /// Time the network alone, on scenes of this many objects, some joined
    #[arg(long, value_name = "OBJECTS", num_args = 0..=1, default_missing_value = "10",
          conflicts_with = "task", value_parser = clap::value_parser!(u16).range(2..=12))]
    crowd: Option<u16>,
    /// Most candidates of the search
    #[arg(long, value_name = "N", default_value_t = 500,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    candidates: u32,
    /// Lateral offsets per face; by default those of the standard effort
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=999))]
    offsets: Option<u16>,
    /// Pushes predicted together
    #[arg(long, value_name = "N", default_value_t = 64,
          value_parser = clap::value_parser!(u16).range(1..=4096))]
    batch: u16,
    /// Pushes that are timed
    #[arg(long, value_name = "N", default_value_t = 32,
          value_parser = clap::value_parser!(u16).range(1..=4096))]
    pushes: u16,
    /// Seed of the pushes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
}

/// Candidate-steps that the network is timed on together: one, a search's batch, many.
const NETWORK_BATCHES: [usize; 3] = [1, 64, 512];

pub fn run(args: &BenchArgs, session: &Session) -> Result<u8, CliError> {
    match &args.what {
        What::Tasks(args) => tasks(args, session)?,
        What::Refinement(args) => refinement(args, session)?,
        What::Cost(args) => cost(args, session)?,
    }
    Ok(exit_code::DONE)
}

fn tasks(args: &TasksArgs, session: &Session) -> Result<(), CliError> {
    let library = args.common.library.load()?;
    let tasks = args
        .tasks
        .iter()
        .map(|file| Ok(load_task(file, &library)?))
        .collect::<Result<Vec<Task>, CliError>>()?;
    let model = args.common.model.load()?;
    let planner = Planner::builder(model).effort(args.effort.into()).seed(args.seed).build();
    let bar = session.bar("tasks");
    bar.set_length(tasks.len() as u64);
    let mut solutions = Vec::new();
    for task in &tasks {
        let solution = session.compute(|| planner.solve(task, &library));
        solutions.push(solution.map_err(solve_error)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let rows: Vec<(&Task, &Solution)> = tasks.iter().zip(&solutions).collect();
    let model = planner.model().name();
    let reports: Vec<_> =
        rows.iter().map(|(task, solution)| solution_json(task, solution, model)).collect();
    args.common.print(session, "tasks", &reports, "", &[task_table(&rows)])
}

fn refinement(args: &RefinementArgs, session: &Session) -> Result<(), CliError> {
    let library = args.common.library.load()?;
    let model = args.common.model.load()?;
    let settings = Effort::Standard.settings();
    let spinner = session.spinner("refining");
    let report = session
        .compute(|| refinement_report(&model, &library, &settings, args.seed, args.tasks as usize));
    spinner.finish_and_clear();
    let head = format!(
        "{} random tasks of seed {}, {} at standard effort; {} with a push to refine\n\n",
        report.tasks, report.seed, report.model, report.planned
    );
    args.common.print(session, "refinement", &report, &head, &[refinement_table(&report)])
}

fn cost(args: &CostArgs, session: &Session) -> Result<(), CliError> {
    let Some(task) = &args.task else { return crowd_cost(args, session) };
    let library = args.common.library.load()?;
    let task = load_task(task, &library)?;
    let tools = task.tools(&library)?;
    let model = args.common.model.load()?;
    let planar = ModelName::Planar.load()?;
    let suite = Suite::draw(SuiteKind::Single, &library, args.seed, usize::from(args.pushes));
    let spinner = session.spinner("timing");
    let pushes = push_costs(&model, &suite, usize::from(args.batch))
        .map_err(|error| CliError::unexpected("cannot time a push", &error))?;
    let networks = match args.common.model.weights()? {
        Some(weights) => inference_costs(&weights, &suite.cases, &NETWORK_BATCHES)
            .map_err(|error| CliError::unexpected("cannot time the network", &error))?,
        None => Vec::new(),
    };
    let models: [&dyn EffectModel; 2] = [&*model, &*planar];
    let standard = Effort::Standard.settings().offsets;
    let offsets = args.offsets.map_or(standard, usize::from);
    let searches =
        session.compute(|| search_costs(&models, &task, &tools, offsets, args.candidates as usize));
    spinner.finish_and_clear();
    let mut tables = vec![push_cost_table(&pushes), search_cost_table(&searches)];
    if !networks.is_empty() {
        tables.insert(0, inference_table(&networks));
    }
    let report = json!({"networks": networks, "pushes": pushes, "searches": searches});
    args.common.print(session, "cost", &report, "", &tables)
}

fn crowd_cost(args: &CostArgs, session: &Session) -> Result<(), CliError> {
    let objects = args.crowd.map_or(10, usize::from);
    let weights = args.common.model.weights()?.ok_or_else(|| {
        CliError::usage("only a network can be timed on a crowd", "leave --model out")
    })?;
    let spinner = session.spinner("timing");
    let cases = crowd_cases(objects, args.seed, usize::from(args.pushes));
    let networks = inference_costs(&weights, &cases, &NETWORK_BATCHES)
        .map_err(|error| CliError::unexpected("cannot time the network", &error))?;
    spinner.finish_and_clear();
    let report = json!({"objects": objects, "networks": networks});
    let head = format!("{objects} objects, sparse and dense, mixed joints; times a graph-step\n\n");
    args.common.print(session, "cost", &report, &head, &[inference_table(&networks)])
}

impl Common {
    fn print(
        &self,
        session: &Session,
        name: &str,
        report: &impl Serialize,
        head: &str,
        tables: &[Table],
    ) -> Result<(), CliError> {
        if self.json {
            let report = json!({"schema_version": SCHEMA_VERSION, name: report});
            return session.print(&format!("{report:#}\n"));
        }
        let show = |table: &Table| {
            if self.markdown { table.to_markdown() } else { table.to_text() }
        };
        let tables: Vec<String> = tables.iter().map(show).collect();
        session.print(&format!("{head}{}", tables.join("\n")))
    }
}
