//! Errors of data sets.

use std::path::PathBuf;

use pushplan_bench::store::{Shard, StoreError};
use thiserror::Error;

/// Error of making or reading a data set.
#[derive(Debug, Error)]
pub enum DatasetError {
    /// The configuration requests no data.
    #[error("{0} must be at least 1")]
    Empty(&'static str),
    /// The configuration requests scenes outside the family.
    #[error("{0}")]
    Constraint(String),
    /// The caller cancelled.
    #[error("stopped; the finished episodes are saved; rerun the same command to resume")]
    Cancelled,
    /// The folder cannot be read or written, or holds other data.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// An external engine is unavailable.
    #[error("{0}; set PUSHPLAN_PYTHON to a Python with the package `mujoco`")]
    Player(String),
    /// The folder holds no episodes of this version.
    #[error("{} contains no data of this version of pushplan", path.display())]
    Foreign {
        /// Path of the folder.
        path: PathBuf,
    },
    /// The folder holds one shard of a data set.
    #[error(
        "{} is shard {shard} of a data set; `pushplan-learn merge OUT SHARD...` merges shards",
        path.display()
    )]
    Shard {
        /// Path of the folder.
        path: PathBuf,
        /// Shard in the folder.
        shard: Shard,
    },
}
