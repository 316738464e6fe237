//! Why a run cannot go on.

use thiserror::Error;

use pushplan::asset::Faults;
use pushplan::effect::ModelError;
use pushplan::solve::SolveError;

use super::world::WorldError;

/// Why a run cannot go on. What was done is in the trace.
#[derive(Debug, Error)]
pub enum ActError {
    /// The task cannot be tried.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// What was learnt cannot be planned with.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// It is no longer possible to act in the world.
    #[error(transparent)]
    World(#[from] WorldError),
    /// Another table is seen.
    #[error("{found} objects are reported where the task has {expected}")]
    Objects {
        /// Objects of the task.
        expected: usize,
        /// Objects that were reported.
        found: usize,
    },
    /// The goal's object is no longer seen.
    #[error("`{object}` is not seen, though the tool is lifted and {looks} looks were taken")]
    Lost {
        /// Its name.
        object: String,
        /// How often was looked.
        looks: usize,
    },
    /// The trace is of another run, or was damaged.
    #[error("the trace does not fit: {0}")]
    Trace(String),
    /// The trace cannot be kept.
    #[error(transparent)]
    Keep(#[from] Faults),
    /// Stopped from outside.
    #[error("stopped after {pushes} pushes")]
    Stopped {
        /// Pushes that were made and kept.
        pushes: usize,
    },
}

impl From<ActError> for pushplan::Error {
    fn from(error: ActError) -> Self {
        Self::Other(Box::new(error))
    }
}
