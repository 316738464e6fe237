//! Errors of input to the planner.

use std::fmt;

use thiserror::Error;

use crate::asset::Faults;
use crate::effect::ModelError;
use crate::outcome::Warning;

/// Error of a task that cannot be attempted. A missing plan is not an error.
#[derive(Error)]
pub enum SolveError {
    /// The task names tools that the library lacks, or there are no tools.
    #[error(transparent)]
    Tools(#[from] Faults),
    /// A value of the task is invalid. Tasks from files are already checked; this concerns tasks
    /// created in code.
    #[error("task `{task}`: {what}")]
    BadTask {
        /// Name of the task.
        task: String,
        /// Fault.
        what: String,
    },
    /// The effect model is not reliable for this task, and its policy refuses such tasks.
    #[error("task `{task}`: {}", list(warnings))]
    Refused {
        /// Name of the task.
        task: String,
        /// Warnings that place the task outside the model's training range.
        warnings: Vec<Warning>,
    },
    /// The library was built with damaged weights.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// Prints the text of [`Display`](fmt::Display), which reads well as the error of `main`.
impl fmt::Debug for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

fn list(warnings: &[Warning]) -> String {
    let lines: Vec<String> = warnings.iter().map(Warning::to_string).collect();
    lines.join("\n")
}
