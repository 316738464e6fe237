//! `pushplan bench merge` and `report`: runs that are kept in folders.

use std::path::PathBuf;

use clap::Args;

use crate::bench::{RandomRecord, SolvedTask, ToolRecord};
use crate::cli::{error::CliError, form::Form, output, session::Session};
use crate::report::{Document, RandomRun, random_document, solved_document, tools_document};
use crate::store::{RunManifest, Store, StoreError, merge_runs};

use super::{keep, random, tasks, tools};

/// Put the shards of a run together: the same bytes as one run
#[derive(Args, Debug)]
#[command(after_help = "Example:
  pushplan bench random --out part-1 --shard 1/2      # here
  pushplan bench random --out part-2 --shard 2/2      # there
  pushplan bench merge whole part-1 part-2")]
pub struct MergeArgs {
    /// Folder for the merged run; must hold none
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// Folders of all shards, in any order
    #[arg(required = true, value_name = "SHARD")]
    shards: Vec<PathBuf>,
    #[command(flatten)]
    form: Form,
}

/// Show runs that are kept in folders, several of one suite side by side
#[derive(Args, Debug)]
pub struct ReportArgs {
    /// Folders of runs
    #[arg(required = true, value_name = "DIR")]
    runs: Vec<PathBuf>,
    /// Folder for the report (HTML) and a table (CSV)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    form: Form,
}

pub fn merge(args: &MergeArgs, session: &Session) -> Result<(), CliError> {
    merge_runs(&args.out, &args.shards)?;
    let runs = std::slice::from_ref(&args.out);
    keep::show(args.form, session, &document(runs)?, Some(&args.out))
}

pub fn report(args: &ReportArgs, session: &Session) -> Result<(), CliError> {
    let document = document(&args.runs)?;
    if let Some(out) = &args.out {
        output::prepare(out)?;
    }
    keep::show(args.form, session, &document, args.out.as_deref())
}

/// The report of one suite's runs.
fn document(runs: &[PathBuf]) -> Result<Document, CliError> {
    let mut suites = Vec::new();
    for dir in runs {
        suites.push(RunManifest::expect(dir)?.suite);
    }
    let suite = suites[0].as_str();
    if let Some(other) = suites.iter().position(|other| other != suite) {
        return Err(CliError::usage(
            format!(
                "{} holds the suite `{}`, {} `{suite}`",
                runs[other].display(),
                suites[other],
                runs[0].display()
            ),
            "show suites one by one",
        ));
    }
    match (suite, runs) {
        (tasks::SUITE, [dir]) => {
            let store = Store::<SolvedTask>::load(dir)?;
            Ok(solved_document(store.manifest(), store.finished()))
        }
        (tools::SUITE, [dir]) => {
            let store = Store::<ToolRecord>::load(dir)?;
            Ok(tools_document(store.manifest(), store.finished()))
        }
        (tasks::SUITE | tools::SUITE, _) => Err(CliError::usage(
            format!("runs of the suite `{suite}` are not shown side by side"),
            "name one folder",
        )),
        (random::SUITE, runs) => {
            let runs: Vec<RandomRun> = runs
                .iter()
                .map(|dir| Ok(Store::<RandomRecord>::load(dir)?.into_parts()))
                .collect::<Result<_, StoreError>>()?;
            same_tasks(&runs)?;
            Ok(random_document(&runs))
        }
        _ => Err(CliError::File(format!(
            "{} holds a suite that this program does not know: `{suite}`",
            runs[0].display()
        ))),
    }
}

/// Methods are compared on the same tasks only.
fn same_tasks(runs: &[RandomRun]) -> Result<(), CliError> {
    let tasks = |run: &RunManifest| {
        let decides = ["kinds", "tasks_version", "tools"].map(|key| run.settings[key].to_string());
        (run.seed, run.tasks, run.shard, decides)
    };
    let Some((first, others)) = runs.split_first() else { return Ok(()) };
    match others.iter().find(|(run, _)| tasks(run) != tasks(&first.0)) {
        Some((other, _)) => Err(CliError::usage(
            format!(
                "the runs are of different tasks: seed {}, {} tasks beside seed {}, {} tasks",
                first.0.seed, first.0.tasks, other.seed, other.tasks
            ),
            "compare runs with the same --seed, --count, --kind, --shard and --tools",
        )),
        None => Ok(()),
    }
}
