//! What can go wrong with a data set.

use std::path::PathBuf;

use pushplan_bench::store::{Shard, StoreError};
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
    /// The folder cannot be read or written, or holds something else.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Another engine cannot be asked.
    #[error("{0}; PUSHPLAN_PYTHON names a Python with the package `mujoco`")]
    Player(String),
    /// The folder holds something else than episodes, or those of another version.
    #[error("{} does not hold data of this version of pushplan", path.display())]
    Foreign {
        /// The folder.
        path: PathBuf,
    },
    /// The folder holds a part of a data set.
    #[error(
        "{} is shard {shard} of a data set; `pushplan-learn merge OUT SHARD...` puts shards together",
        path.display()
    )]
    Shard {
        /// The folder.
        path: PathBuf,
        /// Which part.
        shard: Shard,
    },
}
