//! Errors of runs on disk.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use pushplan::asset::Faults;

use super::numbers::Numbers;
use super::shard::Shard;

/// Error of starting, resuming, reading or merging a run.
#[derive(Debug, Error)]
pub enum StoreError {
    /// Cancellation by the caller.
    #[error("stopped after {done} of {total} tasks")]
    Cancelled {
        /// Number of finished tasks, including earlier runs.
        done: usize,
        /// Number of tasks of this run.
        total: usize,
    },
    /// Error of the file system.
    #[error("cannot {doing} {}: {source}", path.display())]
    Io {
        /// Attempted operation.
        doing: &'static str,
        /// Affected path.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// Error of writing a whole file.
    #[error("{0}")]
    Write(Faults),
    /// Invalid manifest.
    #[error("{} is not a valid manifest: {source}", path.display())]
    Manifest {
        /// Path of the manifest.
        path: PathBuf,
        /// Parse error.
        source: serde_json::Error,
    },
    /// Folder that holds a different run.
    #[error(
        "{} holds a different run; choose another folder, or use the settings of this run:{}",
        path.display(),
        list(differences)
    )]
    OtherRun {
        /// Path of the folder.
        path: PathBuf,
        /// Differences, a line each.
        differences: Vec<String>,
    },
    /// Damaged file.
    #[error("{}:{record}: {why}; move the folder away and run the command again", path.display())]
    Damaged {
        /// Path of the file.
        path: PathBuf,
        /// Number of the record, from 1; for text files the line.
        record: usize,
        /// Description of the damage.
        why: String,
    },
    /// Records without a manifest, which cannot be attributed to a run.
    #[error("{} holds records without a manifest; choose another folder", path.display())]
    Stray {
        /// Path of the folder.
        path: PathBuf,
    },
    /// Folder without a run.
    #[error(
        "{} holds neither data nor a benchmark; create them with `pushplan-learn generate DIR` or \
         `pushplan bench ... --out DIR`",
        path.display()
    )]
    Missing {
        /// Path of the folder.
        path: PathBuf,
    },
    /// Folder to which another process writes.
    #[error(
        "another pushplan is writing to {}{}; wait for it, or choose another folder",
        path.display(),
        brackets(writer)
    )]
    Busy {
        /// Path of the folder.
        path: PathBuf,
        /// Process and host, if the lock file contains them.
        writer: Option<String>,
    },
    /// Record that does not survive a round trip, for example because it contains an undefined
    /// number.
    #[error("cannot store the record of task {index}: {why}")]
    Record {
        /// Index of the task.
        index: usize,
        /// Cause.
        why: String,
    },
    /// Run with unfinished tasks.
    #[error(
        "the run in {} has {done} of {total} tasks; run the same command again to finish it",
        path.display()
    )]
    Unfinished {
        /// Path of the folder.
        path: PathBuf,
        /// Number of finished tasks.
        done: usize,
        /// Number of tasks of the run.
        total: usize,
    },
    /// Duplicate shard.
    #[error(
        "{} and {} are both shard {shard}; name only one of them",
        first.display(),
        second.display()
    )]
    DuplicateShard {
        /// Duplicated shard.
        shard: Shard,
        /// First folder.
        first: PathBuf,
        /// Second folder.
        second: PathBuf,
    },
    /// Incomplete set of shards.
    #[error("a merge needs all {of} shards; missing: {}", Numbers(missing))]
    MissingShards {
        /// Number of shards of the run.
        of: usize,
        /// Numbers of the missing shards.
        missing: Vec<usize>,
    },
    /// Folder of a merge that already holds a run.
    #[error("{} already holds a run; merge into another folder", path.display())]
    Occupied {
        /// Path of the folder.
        path: PathBuf,
    },
    /// Merge without shards.
    #[error("no folders to merge")]
    NothingToMerge,
    /// Folders without a run.
    #[error("no run in these folders: {}", folders(paths))]
    NoRun {
        /// Paths of the folders.
        paths: Vec<PathBuf>,
    },
}

impl StoreError {
    /// Returns a converter from file-system errors of `doing` something to `path`.
    pub(super) fn io(doing: &'static str, path: &Path) -> impl Fn(io::Error) -> Self {
        move |source| StoreError::Io { doing, path: path.to_owned(), source }
    }
}

fn list(lines: &[String]) -> String {
    lines.iter().map(|line| format!("\n  {line}")).collect()
}

fn brackets(text: &Option<String>) -> String {
    text.as_ref().map_or(String::new(), |text| format!(" ({text})"))
}

fn folders(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ")
}
