//! `pushplan bench merge` and `report`: runs that are kept in folders.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::bench::{
    BeliefCase, BeliefRecord, ClosedRecord, Evaluated, LeverRecord, MassCase, MassRecord,
    ProbeCase, ProbeRecord, RandomRecord, RefinedTask, SolvedTask, ToolRecord, TradeOff, by_kind,
};
use crate::cli::{
    error::CliError, evaluate, form::Form, generate::data_error, output, session::Session,
};
use crate::dataset::{self, merge_data};
use crate::report::{
    ClosedRun, Document, RandomRun, closed_document, evaluation_document, lever_tasks_document,
    random_document, solved_document, tools_document,
};
use crate::store::{self, Finished, RunManifest, Store, StoreError, line_index, merge_runs};

use super::page::PageArgs;
use super::{joints, keep, lever_tasks, masses, probes, random, refinement, tasks, tools};

/// Put the shards of a benchmark or of training data together: the same bytes as one run
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
    page: PageArgs,
    #[command(flatten)]
    form: Form,
}

pub fn merge(args: &MergeArgs, session: &Session) -> Result<(), CliError> {
    let (out, shards) = (&args.out, &args.shards);
    let suite = shards.first().map(|dir| RunManifest::expect(dir)).transpose()?;
    let suite = suite.map(|manifest| manifest.suite).unwrap_or_default();
    if [dataset::SUITE, dataset::LEVER_SUITE].contains(&suite.as_str()) {
        let (episodes, seed) = merge_data(out, shards).map_err(data_error)?;
        return session
            .print(&format!("{episodes} episodes of seed {seed} in {}\n", out.display()));
    }
    let whole = merge_runs(out, shards, store::Form::Lines, &mut line_index)?;
    if suite == TradeOff::SUITE {
        // Its report needs the networks that were measured, which only the command names.
        return session.print(&format!(
            "{} units in {}; the command of the shards with this folder and without --shard shows \
             the results\n",
            whole.tasks,
            out.display()
        ));
    }
    let runs = std::slice::from_ref(out);
    keep::show(args.form, session, &document(runs)?, Some(&args.out))
}

pub fn report(args: &ReportArgs, session: &Session) -> Result<(), CliError> {
    let mut document = document(&args.runs)?;
    if let Some(out) = &args.out {
        output::prepare(out)?;
        if let Some(task) = args.page.wanted() {
            document.wrote(&[page(args, task, out, session)?]);
        }
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
        (joints::SUITE, [dir]) => {
            let store = Store::<BeliefRecord>::load(dir)?;
            let cases = serde_json::from_value(store.manifest().settings["cases"].clone());
            let cases: Vec<BeliefCase> = cases.unwrap_or_default();
            Ok(joints::document(&cases, store.finished()))
        }
        (masses::SUITE, [dir]) => {
            let store = Store::<MassRecord>::load(dir)?;
            let cases = serde_json::from_value(store.manifest().settings["cases"].clone());
            let cases: Vec<MassCase> = cases.unwrap_or_default();
            Ok(masses::document(&cases, store.finished()))
        }
        (probes::SUITE, [dir]) => {
            let store = Store::<ProbeRecord>::load(dir)?;
            let cases = serde_json::from_value(store.manifest().settings["cases"].clone());
            let cases: Vec<ProbeCase> = cases.unwrap_or_default();
            Ok(probes::document(&cases, store.finished()))
        }
        (lever_tasks::SUITE, [dir]) => {
            let store = Store::<LeverRecord>::load(dir)?;
            Ok(lever_tasks_document(store.manifest(), store.finished()))
        }
        (super::run::SUITE, runs) => {
            let runs: Vec<ClosedRun> = runs
                .iter()
                .map(|dir| Ok(Store::<ClosedRecord>::load(dir)?.into_parts()))
                .collect::<Result<_, StoreError>>()?;
            same_tasks(&runs)?;
            Ok(closed_document(&runs))
        }
        (refinement::SUITE, [dir]) => {
            let store = Store::<RefinedTask>::load(dir)?;
            Ok(refinement::document(store.manifest(), store.finished()))
        }
        (evaluate::SUITE, [dir]) => {
            let store = Store::<Evaluated>::load(dir)?;
            let (suites, crowds) = by_kind(store.finished().iter().map(|part| &part.record));
            Ok(evaluation_document(&suites, &crowds))
        }
        (TradeOff::SUITE, _) => Err(CliError::usage(
            "the report of a trade-off needs the networks that were measured",
            "give the command of the run again, with its --out: it measures only what is missing",
        )),
        (
            tasks::SUITE
            | tools::SUITE
            | joints::SUITE
            | masses::SUITE
            | probes::SUITE
            | refinement::SUITE
            | evaluate::SUITE
            | lever_tasks::SUITE,
            _,
        ) => Err(CliError::usage(
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

/// The page of one task of the run.
fn page(
    args: &ReportArgs,
    task: &Path,
    out: &Path,
    session: &Session,
) -> Result<PathBuf, CliError> {
    let [dir] = &args.runs[..] else {
        return Err(CliError::usage("a page is of one run", "name one folder"));
    };
    match RunManifest::expect(dir)?.suite.as_str() {
        tasks::SUITE => {
            let store = Store::<SolvedTask>::load(dir)?;
            let run = (store.manifest(), store.manifest().seed);
            let solved = store.finished().iter().map(|task| &task.record);
            args.page.write(task, out, session, run, solved)
        }
        random::SUITE => {
            let store = Store::<RandomRecord>::load(dir)?;
            let solved = store.finished().iter().map(|task| &task.record.solved);
            // The seed of a random run is that of its tasks; its planner has the default one.
            args.page.write(task, out, session, (store.manifest(), 0), solved)
        }
        suite => Err(CliError::usage(
            format!("runs of the suite `{suite}` are not of single plans"),
            "leave out --page",
        )),
    }
}

/// Methods are compared on the same tasks only.
fn same_tasks<R>(runs: &[(RunManifest, Vec<Finished<R>>)]) -> Result<(), CliError> {
    let tasks = |run: &RunManifest| {
        let decides =
            ["kinds", "tasks_version", "tools", "world"].map(|key| run.settings[key].to_string());
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
