//! Errors that end a command early, with their exit codes.

use std::fmt::Display;
use std::io;

use thiserror::Error;

use pushplan::asset::Faults;

use super::exit_code;

/// Error that ends a command.
#[derive(Debug, Error)]
pub enum CliError {
    /// Arguments that are inconsistent with each other or with the task.
    #[error("{message}\n  help: {advice}")]
    Usage {
        /// Description of the fault.
        message: String,
        /// Suggested correction.
        advice: String,
    },
    /// Faults of given files; each contains its own `error:`.
    #[error("{0}")]
    Files(#[from] Faults),
    /// Missing or damaged file or folder, or one of another kind.
    #[error("{0}")]
    File(String),
    /// Request outside the model's range, with the option to refuse it.
    #[error(
        "{0}\n  help: `--out-of-range simulate` simulates instead, `--out-of-range warn` predicts all the same"
    )]
    Refused(String),
    /// Interruption by a signal.
    #[error("{0}")]
    Interrupted(String),
    /// Execution that ended without success.
    #[error("{0}")]
    Ended(String),
    /// Error of writing results; each fault contains its own `error:`.
    #[error("{0}")]
    Output(Faults),
    /// Closed reader of the results.
    #[error("the output was closed")]
    Closed,
    /// Any other error.
    #[error("{0}")]
    Unexpected(String),
}

impl CliError {
    /// Returns an error of the command line.
    pub fn usage(message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), advice: advice.into() }
    }

    /// Returns an error outside the given files.
    pub fn unexpected(doing: &str, error: &dyn Display) -> Self {
        Self::Unexpected(format!("{doing}: {error}"))
    }

    /// Converts an error of writing results.
    pub fn output(error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::Closed,
            _ => Self::unexpected("cannot write the results", error),
        }
    }

    /// Returns the exit code of the process.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage { .. } => exit_code::USAGE,
            Self::Files(_) | Self::File(_) => exit_code::INVALID_FILE,
            Self::Refused(_) => exit_code::REFUSED,
            Self::Ended(_) => exit_code::FAILED_VERIFICATION,
            Self::Interrupted(_) => exit_code::INTERRUPTED,
            // A pipe such as `pushplan ... | head` is no failure.
            Self::Closed => exit_code::DONE,
            Self::Output(_) | Self::Unexpected(_) => exit_code::UNEXPECTED,
        }
    }
}
