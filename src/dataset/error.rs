//! What can go wrong with a data set.

use std::{io, path::PathBuf};

use thiserror::Error;

/// Why a data set could not be made or read.
#[derive(Debug, Error)]
pub enum DatasetError {
    /// The configuration asks for nothing.
    #[error("{0} must be at least 1")]
    Empty(&'static str),
    /// The configuration asks for scenes that the family does not have.
    #[error("{0}")]
    Constraint(String),
    /// The caller asked to stop.
    #[error("stopped; what was finished is kept, run the same command again to go on")]
    Cancelled,
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
    /// A manifest that is none of ours.
    #[error("{} is no manifest of a data set: {source}", path.display())]
    Manifest {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: serde_json::Error,
    },
    /// A file that is not what was written.
    #[error("{} is damaged: {why}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: &'static str,
    },
    /// The folder holds another data set.
    #[error(
        "{} describes a data set of other settings; choose another folder, or remove that one",
        path.display()
    )]
    OtherSettings {
        /// The manifest.
        path: PathBuf,
    },
    /// The folder holds no data set.
    #[error("{} holds no data set; `pushplan generate` makes one", path.display())]
    Missing {
        /// The folder.
        path: PathBuf,
    },
    /// The generation was interrupted.
    #[error(
        "the data set in {} has {there} of {wanted} shards; run `pushplan generate` again with the \
         same settings to finish it",
        path.display()
    )]
    Unfinished {
        /// The folder.
        path: PathBuf,
        /// Shards that are there.
        there: u64,
        /// Shards that it should have.
        wanted: u64,
    },
}
