//! Output format of results.

use clap::Args;

use pushplan_report::Document;

use super::{error::CliError, session::Session};

/// Output format of results; text by default.
#[derive(Args, Clone, Copy, Debug)]
pub struct Form {
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    /// Print Markdown instead of text
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
}

impl Form {
    /// Prints a report.
    ///
    /// # Errors
    /// Returns an error if the output is closed or cannot be written.
    pub fn show(self, session: &Session, document: &Document) -> Result<(), CliError> {
        session.print(&match self {
            Self { json: true, .. } => document.to_json(),
            Self { markdown: true, .. } => document.to_markdown(),
            _ => document.to_text(),
        })
    }

    /// Prints a part of a report that takes minutes, with a blank line, as soon as it is available.
    /// JSON is printed only as a whole.
    ///
    /// # Errors
    /// Returns the errors of [`Form::show`].
    pub fn show_part(self, session: &Session, part: &Document) -> Result<(), CliError> {
        if self.json {
            return Ok(());
        }
        self.show(session, part)?;
        session.print("\n")
    }

    /// Prints the whole report after its parts: in JSON, or if there is content `left`.
    ///
    /// # Errors
    /// Returns the errors of [`Form::show`].
    pub fn show_rest(
        self,
        session: &Session,
        whole: &Document,
        left: bool,
    ) -> Result<(), CliError> {
        if self.json || left { self.show(session, whole) } else { Ok(()) }
    }
}
