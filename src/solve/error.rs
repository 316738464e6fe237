//! Bad input to the planner.

use std::fmt;

use thiserror::Error;

use crate::asset::Faults;
use crate::effect::ModelError;
use crate::outcome::Warning;

/// Errors of tasks that cannot be tried. Not finding a plan is not an error.
#[derive(Error)]
pub enum SolveError {
    /// The task names tools that the library does not have, or there are none.
    #[error(transparent)]
    Tools(#[from] Faults),
    /// A number of the task makes no sense. Tasks from files have been checked already; this is for
    /// those made in code.
    #[error("task `{task}`: {what}")]
    BadTask {
        /// Name of the task.
        task: String,
        /// Fault.
        what: String,
    },
    /// The effect model should not be trusted with this task, and was told to refuse then.
    #[error("task `{task}`: {}", list(warnings))]
    Refused {
        /// Name of the task.
        task: String,
        /// Warnings that put it outside the model's training range.
        warnings: Vec<Warning>,
    },
    /// The library was built around damaged weights.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// The text of [`Display`](fmt::Display), so that it reads well when it leaves `main`.
impl fmt::Debug for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

fn list(warnings: &[Warning]) -> String {
    let lines: Vec<String> = warnings.iter().map(Warning::to_string).collect();
    lines.join("\n")
}
