//! `pushplan bench merge` and `report`: runs that are kept in folders.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::{Serialize, de::DeserializeOwned};

use crate::bench::{SolvedTask, ToolRecord};
use crate::cli::{error::CliError, form::Form, output, session::Session};
use crate::report::{Document, solved_document, tools_document};
use crate::store::{self, Finished, RunManifest, Store, line_index, merge_runs};

use super::page::PageArgs;
use super::{keep, tasks, tools};

/// Put the shards of a benchmark together: the same bytes as one run
#[derive(Args, Debug)]
#[command(after_help = "Example:
  pushplan bench tools --out part-1 --shard 1/2      # here
  pushplan bench tools --out part-2 --shard 2/2      # there
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

/// A suite whose runs are kept, and what is shown of them.
pub struct Kept {
    /// Its name in manifests.
    pub suite: &'static str,
    /// The report of the runs in these folders; none where only the command that measures has all
    /// that it needs.
    pub document: Option<fn(&[PathBuf]) -> Result<Document, CliError>>,
    /// The solved tasks of a run, and the seed of their disturbed replays, where it has any.
    pub solved: Option<fn(&Path) -> Result<(RunManifest, u64, Vec<SolvedTask>), CliError>>,
}

/// The suites of this command.
pub const SUITES: [Kept; 2] = [
    Kept {
        suite: tasks::SUITE,
        document: Some(|runs| one(runs, solved_document)),
        solved: Some(|dir| {
            let (manifest, finished) = Store::<SolvedTask>::load(dir)?.into_parts();
            let seed = manifest.seed;
            Ok((manifest, seed, finished.into_iter().map(|task| task.record).collect()))
        }),
    },
    Kept {
        suite: tools::SUITE,
        document: Some(|runs| one::<ToolRecord>(runs, tools_document)),
        solved: None,
    },
];

/// The report of the only folder of a suite whose runs are not shown side by side.
///
/// # Errors
/// Several folders, and one that cannot be read.
pub fn one<R: Serialize + DeserializeOwned>(
    runs: &[PathBuf],
    document: impl Fn(&RunManifest, &[Finished<R>]) -> Document,
) -> Result<Document, CliError> {
    let [dir] = runs else {
        return Err(CliError::usage(
            "runs of this suite are not shown side by side",
            "name one folder",
        ));
    };
    let store = Store::<R>::load(dir)?;
    Ok(document(store.manifest(), store.finished()))
}

/// Merges shards of one of these `suites` and shows what they hold together.
///
/// # Errors
/// Folders that are not the shards of one run, or hold another suite.
pub fn merge(args: &MergeArgs, suites: &[Kept], session: &Session) -> Result<(), CliError> {
    let (out, shards) = (&args.out, &args.shards);
    let kept = shards.first().map(|first| known(suites, first)).transpose()?;
    let whole = merge_runs(out, shards, store::Form::Lines, &mut line_index)?;
    if kept.is_some_and(|kept| kept.document.is_none()) {
        return session.print(&format!(
            "{} units in {}; the command of the shards with this folder and without --shard shows \
             the results\n",
            whole.tasks,
            out.display()
        ));
    }
    let runs = std::slice::from_ref(out);
    keep::show(args.form, session, &document(suites, runs)?, Some(&args.out))
}

/// Shows runs of one of these `suites`.
///
/// # Errors
/// Folders that hold no such run; a page of a run without plans.
pub fn report(args: &ReportArgs, suites: &[Kept], session: &Session) -> Result<(), CliError> {
    let mut document = document(suites, &args.runs)?;
    if let Some(out) = &args.out {
        output::prepare(out)?;
        if let Some(task) = args.page.wanted() {
            document.wrote(&[page(args, suites, task, out, session)?]);
        }
    }
    keep::show(args.form, session, &document, args.out.as_deref())
}

/// The report of one suite's runs.
fn document(suites: &[Kept], runs: &[PathBuf]) -> Result<Document, CliError> {
    let mut names = Vec::new();
    for dir in runs {
        names.push(RunManifest::expect(dir)?.suite);
    }
    let suite = names[0].as_str();
    if let Some(other) = names.iter().position(|other| other != suite) {
        return Err(CliError::usage(
            format!(
                "{} holds the suite `{}`, {} `{suite}`",
                runs[other].display(),
                names[other],
                runs[0].display()
            ),
            "show suites one by one",
        ));
    }
    match known(suites, &runs[0])?.document {
        Some(document) => document(runs),
        None => Err(CliError::usage(
            format!("the report of the suite `{suite}` needs more than what is kept"),
            "give the command of the run again, with its --out: it measures only what is missing",
        )),
    }
}

/// The suite of the run in a folder.
fn known<'a>(suites: &'a [Kept], dir: &Path) -> Result<&'a Kept, CliError> {
    let name = RunManifest::expect(dir)?.suite;
    suites.iter().find(|kept| kept.suite == name).ok_or_else(|| {
        CliError::File(format!(
            "{} holds a suite that this program does not know: `{name}`",
            dir.display()
        ))
    })
}

/// The page of one task of the run.
fn page(
    args: &ReportArgs,
    suites: &[Kept],
    task: &Path,
    out: &Path,
    session: &Session,
) -> Result<PathBuf, CliError> {
    let [dir] = &args.runs[..] else {
        return Err(CliError::usage("a page is of one run", "name one folder"));
    };
    let kept = known(suites, dir)?;
    let Some(solved) = kept.solved else {
        return Err(CliError::usage(
            format!("runs of the suite `{}` are not of single plans", kept.suite),
            "leave out --page",
        ));
    };
    let (run, seed, solved) = solved(dir)?;
    args.page.write(task, out, session, (&run, seed), solved.iter())
}
