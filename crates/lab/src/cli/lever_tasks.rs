//! `pushplan-lab lever-tasks`: generated tasks of levering.

use std::path::{Path, PathBuf};

use clap::Args;
use pushplan::cli::action::LibraryArgs;
use pushplan::cli::bench::keep;
use pushplan::cli::bench::keep::{KeepArgs, value_digest};
use pushplan::cli::error::CliError;
use pushplan::cli::form::Form;
use pushplan::cli::session::Session;
use pushplan::cli::solve::solve_error;
use pushplan::cli::words::{EFFORTS, words};
use pushplan::cli::{interrupt, lever, model, output};
use pushplan::internals::scene::ModelSpec;
use pushplan::internals::solve::Effort;
use pushplan::internals::solve::lever::LeverPlanner;
use pushplan::internals::store::RunManifest;
use serde_json::json;

use crate::bench::LeverSuite;
use crate::report::lever_tasks_document;

/// Name of the suite in manifests.
pub const SUITE: &str = "lever-tasks";

/// Solve generated tasks of levering: take the board out of a drive
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
    /// How hard to try
    #[arg(long, value_parser = words(&EFFORTS), default_value = "standard")]
    effort: Effort,
    #[arg(long, value_name = "MODEL", help = model::HELP_FOR_LEVERS)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Also write the tasks to this folder, for `pushplan solve`
    #[arg(long, value_name = "DIR")]
    save_tasks: Option<PathBuf>,
    #[command(flatten)]
    keep: KeepArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &LeverTasksArgs, session: &Session) -> Result<(), CliError> {
    let library = args.library.load()?;
    let count = args.count as usize;
    let suite = LeverSuite::new(args.seed, count);
    let planner = LeverPlanner::new(lever::lever_model(args.model.as_ref())?, args.effort);
    let tools: Vec<_> = library.blades().iter().map(|tool| &**tool).collect();
    let settings = json!({
        "effort": args.effort,
        "budget": planner.settings(),
        "tasks_version": LeverSuite::VERSION,
        "tools": value_digest(&tools)?,
    });
    let manifest =
        RunManifest::new(SUITE, count, args.seed, &planner.model().name()).with_settings(settings);
    if let Some(folder) = &args.save_tasks {
        save_tasks(folder, &suite, args.keep.indices(count))?;
    }
    let store = args.keep.measure(session, manifest, |index| {
        session.compute(|| suite.measure(&planner, &library, index)).map_err(solve_error)
    })?;
    let (manifest, finished) = store.into_parts();
    let document = lever_tasks_document(&manifest, &finished);
    keep::show(args.form, session, &document, args.keep.out.as_deref())
}

/// Writes the tasks of a run as files.
fn save_tasks(
    folder: &Path,
    suite: &LeverSuite,
    indices: impl Iterator<Item = usize>,
) -> Result<(), CliError> {
    output::prepare(folder)?;
    interrupt::watch();
    for index in indices {
        if interrupt::requested() {
            return Err(CliError::Interrupted("stopped while saving the tasks".to_owned()));
        }
        let task = suite.task(index);
        let text = task.to_yaml().map_err(CliError::Output)?;
        output::write(folder, &format!("{}.yaml", task.name), text.as_bytes())?;
    }
    Ok(())
}
