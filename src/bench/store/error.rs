//! What can go wrong with a benchmark run on disk.

use std::{io, path::PathBuf};

use thiserror::Error;

use crate::asset::Faults;

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
    /// A manifest that is none of ours.
    #[error("{} is no manifest of a benchmark: {source}", path.display())]
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
    #[error("{}:{line}: {why}; move the folder away and measure again", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
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
    #[error("{} holds no benchmark run; `pushplan bench ... --out DIR` makes one", path.display())]
    Missing {
        /// The folder.
        path: PathBuf,
    },
    /// Another process writes to the folder.
    #[error("another pushplan is writing to {}; wait for it, or choose another folder", path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// A record that would not be read as it was written, such as one with an undefined number.
    #[error("the record of task {index} cannot be kept: {source}")]
    Record {
        /// Index of the task.
        index: usize,
        /// Why not.
        source: serde_json::Error,
    },
    /// A shard with tasks still to do.
    #[error(
        "shard {shard} in {} has {done} of {total} tasks; run its command again to finish it",
        path.display()
    )]
    Unfinished {
        /// The folder.
        path: PathBuf,
        /// Which shard.
        shard: Shard,
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
    #[error("to merge, all {of} shards are needed; missing: {}", numbers(missing))]
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
}

fn list(lines: &[String]) -> String {
    lines.iter().map(|line| format!("\n  {line}")).collect()
}

fn numbers(list: &[usize]) -> String {
    list.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}
