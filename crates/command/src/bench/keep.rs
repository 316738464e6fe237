//! Benchmarks saved in a folder, which can be resumed and split.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use serde::{Serialize, de::DeserializeOwned};

use crate::{
    error::CliError, form::Form, interrupt, model, output, progress::TerminalProgress,
    session::Session,
};
use pushplan::scene::{ModelSpec, Tool};
use pushplan_bench::store::{Measured, RunManifest, Shard, Store, StoreError, digest};
use pushplan_report::Document;

/// Names of the report files next to the records.
const PAGE: &str = "report.html";
const ROWS: &str = "tasks.csv";

/// Section of `--help` for saved benchmarks.
pub const HELP: &str = "With --out, each finished task is saved as soon as all earlier tasks are \
saved. After an interruption (Ctrl-C), rerun the same command to resume. manifest.json and \
records.jsonl are then byte-identical to an uninterrupted run; times.jsonl contains the wall \
times, which differ.

--shard 2/3 measures every third task, for example on another machine. `merge OUT SHARD...` \
combines the shards into the files of a single run, `status SHARD...` lists missing shards, and \
`report DIR...` reports saved runs.";

/// Storage of the results.
#[derive(Args, Debug)]
pub struct KeepArgs {
    /// Folder for the result of every task, a report (HTML) and a table (CSV)
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Measure only shard I of N
    #[arg(long, value_name = "I/N", requires = "out")]
    shard: Option<Shard>,
}

/// Results of a run.
pub struct Kept<R> {
    /// Finished tasks.
    pub store: Store<R>,
    /// Interruption that left the run unfinished, if any.
    pub interruption: Option<CliError>,
}

impl KeepArgs {
    /// Returns the indices of the tasks that this part of a run measures, of `count`.
    pub fn indices(&self, count: usize) -> impl ExactSizeIterator<Item = usize> {
        self.shard.unwrap_or(Shard::WHOLE).indices(count)
    }

    /// Measures the remaining tasks of a run, with progress on stderr.
    ///
    /// # Errors
    /// Returns the errors of [`Store::open`] and `measure`.
    pub fn measure<R: Serialize + DeserializeOwned>(
        &self,
        session: &Session,
        manifest: RunManifest,
        measure: impl FnMut(usize) -> Result<Measured<R>, CliError>,
    ) -> Result<Kept<R>, CliError> {
        self.kept(session, manifest, |store, following| store.run(following, measure))
    }

    /// Measures the remaining tasks, one on each of the session's threads, without shared work.
    ///
    /// # Errors
    /// Returns the errors of [`Store::open`].
    pub fn measure_side_by_side<R: Serialize + DeserializeOwned + Send>(
        &self,
        session: &Session,
        manifest: RunManifest,
        measure: impl Fn(usize) -> Measured<R> + Sync,
    ) -> Result<Kept<R>, CliError> {
        self.kept(session, manifest, |store, following| {
            let alone = |index| session.compute_alone(|| measure(index));
            Ok(store.run_side_by_side(following, session.threads(), alone)?)
        })
    }

    fn kept<R: Serialize + DeserializeOwned>(
        &self,
        session: &Session,
        manifest: RunManifest,
        run: impl FnOnce(&mut Store<R>, &TerminalProgress<'_>) -> Result<(), CliError>,
    ) -> Result<Kept<R>, CliError> {
        let manifest = match self.shard {
            Some(shard) => manifest.with_shard(shard),
            None => manifest,
        };
        interrupt::watch();
        let following = TerminalProgress::bar(session, "tasks");
        let mut store = match &self.out {
            Some(dir) => Store::open(dir, manifest, &following)?,
            None => Store::in_memory(manifest),
        };
        let measured = run(&mut store, &following);
        following.finish()?;
        let interruption = match measured {
            Err(CliError::Interrupted(message)) => Some(CliError::Interrupted(match &self.out {
                Some(_) => format!("{message}; rerun the same command to resume"),
                None => format!("{message}; results are saved only with --out DIR"),
            })),
            measured => measured.map(|()| None)?,
        };
        Ok(Kept { store, interruption })
    }
}

/// Prints a report, and writes its page and rows into the folder of a run, if any.
///
/// # Errors
/// Returns an error if the report cannot be written.
pub fn show(
    form: Form,
    session: &Session,
    document: &Document,
    folder: Option<&Path>,
) -> Result<(), CliError> {
    if let Some(folder) = folder {
        output::write(folder, PAGE, document.to_html().as_bytes())?;
        output::write(folder, ROWS, document.to_csv().as_bytes())?;
    }
    form.show(session, document)
}

/// Returns a digest of a network's weights; `None` for a model without weights.
///
/// # Errors
/// Returns an error if the weights cannot be read.
pub fn weights_digest(spec: &ModelSpec) -> Result<Option<String>, CliError> {
    let Some(weights) = model::weights(spec)? else { return Ok(None) };
    let bytes = weights.to_bytes();
    let bytes = bytes.map_err(|error| CliError::unexpected("cannot read the weights", &error))?;
    Ok(Some(digest(&bytes)))
}

/// Returns a digest of a value.
///
/// # Errors
/// Returns an error if the value cannot be written as JSON, which does not occur for our types.
pub fn value_digest(value: &impl Serialize) -> Result<String, CliError> {
    let text = serde_json::to_vec(value);
    let text = text.map_err(|error| CliError::unexpected("cannot write JSON", &error))?;
    Ok(digest(&text))
}

/// Returns a digest of tools.
///
/// # Errors
/// Returns the errors of [`value_digest`].
pub fn tools_digest<'a>(tools: impl Iterator<Item = &'a Arc<Tool>>) -> Result<String, CliError> {
    value_digest(&tools.map(|tool| &**tool).collect::<Vec<_>>())
}

impl From<StoreError> for CliError {
    fn from(error: StoreError) -> Self {
        let message = error.to_string();
        match error {
            StoreError::Cancelled { .. } => Self::Interrupted(message),
            StoreError::Write(faults) => Self::Output(faults),
            StoreError::OtherRun { .. } | StoreError::Stray { .. } => {
                Self::usage(message, "to resume an unfinished run, repeat its command exactly")
            }
            StoreError::DuplicateShard { .. }
            | StoreError::MissingShards { .. }
            | StoreError::Occupied { .. }
            | StoreError::NothingToMerge => Self::usage(
                message,
                "name a new folder, then the folders of all shards: merge OUT SHARD...",
            ),
            StoreError::Manifest { .. }
            | StoreError::Damaged { .. }
            | StoreError::Missing { .. }
            | StoreError::NoRun { .. }
            | StoreError::Unfinished { .. } => Self::File(message),
            StoreError::Io { .. } | StoreError::Busy { .. } | StoreError::Record { .. } => {
                Self::Unexpected(message)
            }
        }
    }
}
