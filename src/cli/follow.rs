//! How a long job shows itself on stderr and is stopped by Ctrl-C.

use std::sync::Mutex;

use indicatif::ProgressBar;

use crate::watch::Watch;

use super::{
    error::CliError,
    interrupt,
    session::{Session, count},
};

/// Follows a job with a bar or a spinner.
pub struct Following<'a> {
    session: &'a Session,
    bar: ProgressBar,
    /// Whether the units that it counts are those of a stage.
    staged: bool,
    /// What went wrong while showing; the job is asked to stop then.
    trouble: Mutex<Option<CliError>>,
}

impl<'a> Following<'a> {
    /// A bar, for many equal units of `what`.
    pub fn bar(session: &'a Session, what: &str) -> Self {
        Self { session, bar: session.bar(what), staged: false, trouble: Mutex::default() }
    }

    /// A spinner with the stage and how far it is.
    pub fn spinner(session: &'a Session, what: &str) -> Self {
        Self { session, bar: session.staged(what), staged: true, trouble: Mutex::default() }
    }

    /// Ends the bar.
    ///
    /// # Errors
    /// What went wrong while showing.
    pub fn finish(self) -> Result<(), CliError> {
        self.bar.finish_and_clear();
        let trouble = self.trouble.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        trouble.map_or(Ok(()), Err)
    }

    /// Keeps the first trouble.
    pub fn keep(&self, shown: Result<(), CliError>) {
        if let Err(error) = shown {
            let mut trouble = self.trouble.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            trouble.get_or_insert(error);
        }
    }
}

impl Watch for Following<'_> {
    fn stage(&self, what: &str) {
        if self.staged {
            count(&self.bar, false);
        }
        self.bar.set_message(what.to_owned());
    }

    fn progress(&self, done: u64, total: u64) {
        if self.staged {
            count(&self.bar, total > 0);
        }
        self.bar.set_length(total);
        self.bar.set_position(done);
    }

    fn line(&self, text: &str) {
        self.keep(self.bar.suspend(|| self.session.print(&format!("{text}\n"))));
    }

    fn note(&self, message: &str) {
        self.bar.suspend(|| self.session.warn(message));
    }

    fn cancelled(&self) -> bool {
        let trouble = self.trouble.lock().map_or(true, |trouble| trouble.is_some());
        trouble || interrupt::requested()
    }
}
