//! What can go wrong with a data set.

use thiserror::Error;

/// Why a data set could not be made or read.
#[derive(Debug, Error)]
pub enum DatasetError {
    /// The configuration asks for nothing.
    #[error("{0} must be at least 1")]
    Empty(&'static str),
    /// The caller asked to stop; finished files are kept.
    #[error("stopped; what was finished is kept, run the same command again to go on")]
    Cancelled,
}
