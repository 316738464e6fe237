//! How results are printed.

use clap::Args;

use pushplan_report::Document;

use super::{error::CliError, session::Session};

/// How results are printed; as text unless something else is asked for.
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
    /// If nobody reads it, or it cannot be written.
    pub fn show(self, session: &Session, document: &Document) -> Result<(), CliError> {
        session.print(&match self {
            Self { json: true, .. } => document.to_json(),
            Self { markdown: true, .. } => document.to_markdown(),
            _ => document.to_text(),
        })
    }

    /// Prints a part of a report that takes minutes as soon as it is there, and a blank line; of
    /// JSON there is only the whole.
    ///
    /// # Errors
    /// Those of [`Form::show`].
    pub fn show_part(self, session: &Session, part: &Document) -> Result<(), CliError> {
        if self.json {
            return Ok(());
        }
        self.show(session, part)?;
        session.print("\n")
    }

    /// Prints a whole report whose parts were shown: in JSON, or what is left to say.
    ///
    /// # Errors
    /// Those of [`Form::show`].
    pub fn show_rest(
        self,
        session: &Session,
        whole: &Document,
        left: bool,
    ) -> Result<(), CliError> {
        if self.json || left { self.show(session, whole) } else { Ok(()) }
    }
}
