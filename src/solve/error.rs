//! Errors of input to the planner.

use std::fmt;

use thiserror::Error;

use crate::asset::Faults;
use crate::effect::ModelError;
use crate::outcome::Warning;
use crate::task::Task;

/// Error of a task that cannot be attempted. A missing plan is not an error.
#[derive(Error)]
pub enum SolveError {
    /// The task names tools that the library lacks, or there are no tools.
    #[error(transparent)]
    Tools(#[from] Faults),
    /// Values of the task are invalid. Tasks from files are already checked; this concerns tasks
    /// created in code.
    #[error("{}", lines(task, faults))]
    BadTask {
        /// Name of the task.
        task: String,
        /// Faults of the task, at least one.
        faults: Vec<TaskFault>,
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

/// Invalid value of a task created in code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskFault {
    /// Path of the value's key in a task file, such as `scene.objects[0].mass`; empty if the fault
    /// concerns the whole task.
    pub key: String,
    /// Description of the fault.
    pub what: String,
}

impl SolveError {
    /// Returns the error of a task with one fault, at the key path `key`.
    pub fn bad_task(task: &Task, key: impl Into<String>, what: impl Into<String>) -> Self {
        let fault = TaskFault { key: key.into(), what: what.into() };
        Self::BadTask { task: task.name.clone(), faults: vec![fault] }
    }
}

/// Prints the text of [`Display`](fmt::Display), which reads well as the error of `main`.
impl fmt::Debug for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Formats each fault in a line of its own.
fn lines(task: &str, faults: &[TaskFault]) -> String {
    let line = |TaskFault { key, what }: &TaskFault| match key.is_empty() {
        true => format!("task `{task}`: {what}"),
        false => format!("task `{task}`: {key}: {what}"),
    };
    faults.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn list(warnings: &[Warning]) -> String {
    let lines: Vec<String> = warnings.iter().map(Warning::to_string).collect();
    lines.join("\n")
}
