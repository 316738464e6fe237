//! Bad input to the planner.

use thiserror::Error;

use crate::asset::Faults;

/// Why a task cannot even be tried. Not finding a plan is no error.
#[derive(Debug, Error)]
pub enum SolveError {
    /// The task names tools that the library does not have, or there are none.
    #[error(transparent)]
    Tools(#[from] Faults),
    /// A number of the task makes no sense. Tasks read from files are checked there already,
    /// this is for those made in code.
    #[error("task `{task}`: {what}")]
    BadTask {
        /// Name of the task.
        task: String,
        /// What is wrong with it.
        what: String,
    },
}
