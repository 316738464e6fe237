//! Everything that ends a command early, with its exit code.

use std::fmt::Display;
use std::io;

use thiserror::Error;

use pushplan::asset::Faults;

use super::exit_code;

/// Why a command could not finish.
#[derive(Debug, Error)]
pub enum CliError {
    /// Arguments that only make sense together, or not at all, for this task.
    #[error("{message}\n  help: {advice}")]
    Usage {
        /// Description of the fault.
        message: String,
        /// What to try.
        advice: String,
    },
    /// Faults of given files; each says `error:` itself.
    #[error("{0}")]
    Files(#[from] Faults),
    /// A given file or folder that is missing, damaged or of another kind.
    #[error("{0}")]
    File(String),
    /// The model should not be trusted with what is asked, and was told to refuse then.
    #[error(
        "{0}\n  help: `--outside simulate` simulates instead, `--outside warn` predicts all the same"
    )]
    Refused(String),
    /// Stopped by a signal.
    #[error("{0}")]
    Interrupted(String),
    /// What was carried out came to an end that nobody wanted.
    #[error("{0}")]
    Ended(String),
    /// Results that cannot be written; each fault says `error:` itself.
    #[error("{0}")]
    Output(Faults),
    /// Nobody reads the results any more.
    #[error("the output was closed")]
    Closed,
    /// Anything else.
    #[error("{0}")]
    Unexpected(String),
}

impl CliError {
    /// A wrong command line.
    pub fn usage(message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), advice: advice.into() }
    }

    /// A failure outside the given files.
    pub fn unexpected(doing: &str, error: &dyn Display) -> Self {
        Self::Unexpected(format!("{doing}: {error}"))
    }

    /// A failure to write results.
    pub fn output(error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::Closed,
            _ => Self::unexpected("cannot write the results", error),
        }
    }

    /// The process's exit code.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage { .. } => exit_code::USAGE,
            Self::Files(_) | Self::File(_) => exit_code::INVALID_FILE,
            Self::Refused(_) => exit_code::REFUSED,
            Self::Ended(_) => exit_code::FAILED_VERIFICATION,
            Self::Interrupted(_) => exit_code::INTERRUPTED,
            // `pushplan ... | head` is no failure.
            Self::Closed => exit_code::DONE,
            Self::Output(_) | Self::Unexpected(_) => exit_code::UNEXPECTED,
        }
    }
}
