//! What can go wrong with a run on disk.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use pushplan::asset::Faults;

use super::numbers::Numbers;
use super::shard::Shard;

/// Why a run could not be begun, resumed, read or merged.
#[derive(Debug, Error)]
pub enum StoreError {
    /// The caller asked to stop.
    #[error("stopped after {done} of {total} tasks")]
    Cancelled {
        /// Finished tasks, those of earlier runs included.
        done: usize,
        /// Tasks of this run.
        total: usize,
    },
    /// The file system refused.
    #[error("cannot {doing} {}: {source}", path.display())]
    Io {
        /// What was tried.
        doing: &'static str,
        /// On what.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// A whole file could not be written.
    #[error("{0}")]
    Write(Faults),
    /// A manifest of something else.
    #[error("{} is not a manifest of pushplan: {source}", path.display())]
    Manifest {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: serde_json::Error,
    },
    /// The folder holds a run of something else.
    #[error(
        "{} holds another run; choose another folder, or ask for the same:{}",
        path.display(),
        list(differences)
    )]
    OtherRun {
        /// The folder.
        path: PathBuf,
        /// What differs, a line each.
        differences: Vec<String>,
    },
    /// A file that is not what was written.
    #[error("{}:{record}: {why}; move the folder away and run the command again", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The record, from 1; of lines of text it is the line.
        record: usize,
        /// What is wrong with it.
        why: String,
    },
    /// Records without a manifest cannot be told from those of another run.
    #[error("{} holds records, but no manifest says of what; choose another folder", path.display())]
    Stray {
        /// The folder.
        path: PathBuf,
    },
    /// The folder holds no run.
    #[error(
        "{} holds neither data nor a benchmark; `pushplan-learn generate DIR` and `pushplan bench ... \
         --out DIR` make them",
        path.display()
    )]
    Missing {
        /// The folder.
        path: PathBuf,
    },
    /// Another process writes to the folder.
    #[error(
        "another pushplan is writing to {}{}; wait for it, or choose another folder",
        path.display(),
        brackets(writer)
    )]
    Busy {
        /// The folder.
        path: PathBuf,
        /// Process and host, where the lock says so.
        writer: Option<String>,
    },
    /// A record that would not be read as it was written, such as one with an undefined number.
    #[error("the record of task {index} cannot be kept: {why}")]
    Record {
        /// Index of the task.
        index: usize,
        /// Why not.
        why: String,
    },
    /// A run with tasks still to do.
    #[error(
        "the run in {} has {done} of {total} tasks; run its command again to finish it",
        path.display()
    )]
    Unfinished {
        /// The folder.
        path: PathBuf,
        /// Finished tasks.
        done: usize,
        /// Tasks that it should have.
        total: usize,
    },
    /// The same shard twice.
    #[error("{} and {} are both shard {shard}; leave one out", first.display(), second.display())]
    DuplicateShard {
        /// Which shard.
        shard: Shard,
        /// A folder.
        first: PathBuf,
        /// The other one.
        second: PathBuf,
    },
    /// Not all shards were given.
    #[error("to merge, all {of} shards are needed; missing: {}", Numbers(missing))]
    MissingShards {
        /// How many there are.
        of: usize,
        /// Numbers of those that were not given.
        missing: Vec<usize>,
    },
    /// The result of a merge would replace a run.
    #[error("{} holds a run already; merge into another folder", path.display())]
    Occupied {
        /// The folder.
        path: PathBuf,
    },
    /// No shard was given.
    #[error("there is nothing to merge")]
    NothingToMerge,
    /// None of the folders that were asked about holds a run.
    #[error("none of these folders holds a run: {}", folders(paths))]
    NoRun {
        /// The folders.
        paths: Vec<PathBuf>,
    },
}

impl StoreError {
    /// What the file system's refusal of `doing` something to `path` is here.
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
