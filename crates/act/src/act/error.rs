//! Errors of a closed-loop run.

use thiserror::Error;

use pushplan::asset::Faults;
use pushplan::effect::ModelError;
use pushplan::solve::SolveError;

use super::world::WorldError;

/// Error that ends a run. The trace keeps all steps up to it.
#[derive(Debug, Error)]
pub enum ActError {
    /// The task is invalid or cannot be planned.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The network learnt in the run is not accepted by the planner.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The world no longer executes motions or returns observations.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The number of observed objects differs from the task.
    #[error("{found} objects were observed, but the task has {expected}")]
    Objects {
        /// Objects of the task.
        expected: usize,
        /// Number of objects that were observed.
        found: usize,
    },
    /// The object of a goal is no longer observed.
    #[error("`{object}` was not observed in {looks} observations with the tool lifted")]
    Lost {
        /// Name of the object.
        object: String,
        /// Number of observations taken.
        looks: usize,
    },
    /// Two objects of equal shape are observed in each other's places before the first push, so
    /// that the camera or the task may have confused them.
    #[error(
        "`{}` and `{}` look alike and are observed in each other's places, so it is not known \
         which is which; state their positions in the task as they are observed",
        .objects[0], .objects[1]
    )]
    Ambiguous {
        /// Names of the objects.
        objects: [String; 2],
    },
    /// The trace belongs to another run or is damaged.
    #[error("the trace cannot be resumed: {0}")]
    Trace(String),
    /// The trace cannot be written.
    #[error(transparent)]
    Keep(#[from] Faults),
    /// The run was cancelled by the caller.
    #[error("stopped after {pushes} pushes")]
    Stopped {
        /// Number of pushes carried out and recorded.
        pushes: usize,
    },
}

impl From<ActError> for pushplan::Error {
    fn from(error: ActError) -> Self {
        Self::Other(Box::new(error))
    }
}
