//! `pushplan bench merge` and `report`: runs saved in folders.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::{error::CliError, form::Form, output, session::Session};
use pushplan_bench::SolvedTask;
use pushplan_bench::store::{self, RunManifest, Store, line_index, merge_runs};
use pushplan_report::Document;

use super::keep;
use super::page::PageArgs;
use super::suite::{Suite, load};
use super::tasks::TasksArgs;
use super::tools::ToolsArgs;

/// Merge the shards of a benchmark into the files of a single run
#[derive(Args, Debug)]
#[command(after_help = "Example:
  pushplan bench tools --out part-1 --shard 1/2      # here
  pushplan bench tools --out part-2 --shard 2/2      # there
  pushplan bench merge whole part-1 part-2")]
pub struct MergeArgs {
    /// Folder for the merged run; it must not contain a run
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// Folders of all shards, in any order
    #[arg(required = true, value_name = "SHARD")]
    shards: Vec<PathBuf>,
    #[command(flatten)]
    form: Form,
}

/// Report saved runs; several runs of one suite are shown side by side
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

/// Suite with saved runs, and the functions that report on them.
pub struct Kept {
    suite: &'static str,
    /// Report function; `None` if only the measuring command has the data of a report.
    document: Option<Show>,
    solved: fn(&Path) -> Result<Option<SolvedRun>, CliError>,
}

/// Function that creates the report of the runs in folders.
pub type Show = fn(&[PathBuf]) -> Result<Document, CliError>;

/// Manifest of a run, the seed of its perturbed replays, and its solved tasks.
type SolvedRun = (RunManifest, u64, Vec<SolvedTask>);

impl Kept {
    /// Returns the functions for the runs of a suite.
    pub const fn of<S: Suite>() -> Self {
        Self {
            suite: S::NAME,
            document: Some(|dirs| S::document(&load(dirs)?)),
            solved: |dir| {
                let run = Store::<S::Record>::load(dir)?.into_parts();
                let solved = S::solved(&run);
                Ok(solved.map(|(seed, solved)| (run.0, seed, solved)))
            },
        }
    }

    /// Returns the functions for runs with a separate `document`; `None` if their records are not
    /// sufficient for a report.
    pub const fn apart(suite: &'static str, document: Option<Show>) -> Self {
        Self { suite, document, solved: |_| Ok(None) }
    }
}

/// Suites of this command.
pub const SUITES: [Kept; 2] = [Kept::of::<TasksArgs>(), Kept::of::<ToolsArgs>()];

/// Merges shards of one of these `suites` and shows the result.
///
/// # Errors
/// Returns an error if the folders are not the shards of one run, or belong to an unknown suite.
pub fn merge(args: &MergeArgs, suites: &[Kept], session: &Session) -> Result<(), CliError> {
    let (out, shards) = (&args.out, &args.shards);
    let kept = shards.first().map(|first| known(suites, first)).transpose()?;
    let whole = merge_runs(out, shards, store::Form::Lines, &mut line_index)?;
    if kept.is_some_and(|kept| kept.document.is_none()) {
        return session.print(&format!(
            "merged {} units into {}; for the results, run the command of the shards with --out \
             set to this folder and without --shard\n",
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
/// Returns an error if the folders contain no such run, or if a page of a run without plans is
/// wanted.
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

/// Returns the report of one suite's runs.
fn document(suites: &[Kept], runs: &[PathBuf]) -> Result<Document, CliError> {
    let mut names = Vec::new();
    for dir in runs {
        names.push(RunManifest::expect(dir)?.suite);
    }
    let suite = names[0].as_str();
    if let Some(other) = names.iter().position(|other| other != suite) {
        return Err(CliError::usage(
            format!(
                "{} contains a run of suite `{}`, but {} a run of suite `{suite}`",
                runs[other].display(),
                names[other],
                runs[0].display()
            ),
            "report each suite separately",
        ));
    }
    match known(suites, &runs[0])?.document {
        Some(document) => document(runs),
        None => Err(CliError::usage(
            format!("suite `{suite}` cannot be reported from its saved records alone"),
            "rerun the command of the run with its --out; it measures only missing cases",
        )),
    }
}

/// Returns the suite of the run in a folder.
fn known<'a>(suites: &'a [Kept], dir: &Path) -> Result<&'a Kept, CliError> {
    let name = RunManifest::expect(dir)?.suite;
    suites.iter().find(|kept| kept.suite == name).ok_or_else(|| {
        CliError::File(format!(
            "{} contains a run of suite `{name}`, which this program does not support",
            dir.display()
        ))
    })
}

/// Writes the page of one task of the run.
fn page(
    args: &ReportArgs,
    suites: &[Kept],
    task: &Path,
    out: &Path,
    session: &Session,
) -> Result<PathBuf, CliError> {
    let [dir] = &args.runs[..] else {
        return Err(CliError::usage("--page needs exactly one run", "name one folder"));
    };
    let kept = known(suites, dir)?;
    let Some((run, seed, solved)) = (kept.solved)(dir)? else {
        return Err(CliError::usage(
            format!("runs of suite `{}` contain no plans for a page", kept.suite),
            "omit --page",
        ));
    };
    args.page.write(task, out, session, (&run, seed), solved.iter())
}
