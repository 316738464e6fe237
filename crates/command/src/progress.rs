//! Progress of a long job on stderr, and its cancellation by Ctrl-C.

use std::sync::Mutex;

use indicatif::ProgressBar;

use pushplan::progress::Progress;

use super::{
    error::CliError,
    interrupt,
    session::{Session, count, size},
};

/// Progress bar or spinner of a job.
pub struct TerminalProgress<'a> {
    session: &'a Session,
    bar: ProgressBar,
    /// Whether the counted units belong to a stage.
    staged: bool,
    /// Stage, and best answer so far.
    message: Mutex<[String; 2]>,
    /// First error of showing progress, which cancels the job.
    trouble: Mutex<Option<CliError>>,
}

impl<'a> TerminalProgress<'a> {
    /// Returns a bar for many equal units of `what`.
    pub fn bar(session: &'a Session, what: &str) -> Self {
        Self::with(session, session.bar(what), false)
    }

    /// Returns a spinner with the stage and its progress.
    pub fn spinner(session: &'a Session, what: &str) -> Self {
        Self::with(session, session.staged(what), true)
    }

    fn with(session: &'a Session, bar: ProgressBar, staged: bool) -> Self {
        Self { session, bar, staged, message: Mutex::default(), trouble: Mutex::default() }
    }

    /// Changes the shown message.
    fn show(&self, change: impl FnOnce(&mut [String; 2])) {
        let mut message = self.message.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        change(&mut message);
        let [stage, so_far] = &*message;
        let message = if so_far.is_empty() { stage.clone() } else { format!("{stage} ({so_far})") };
        self.bar.set_message(message);
    }

    /// Ends the bar.
    ///
    /// # Errors
    /// Returns the first error of showing progress.
    pub fn finish(self) -> Result<(), CliError> {
        self.bar.finish_and_clear();
        let trouble = self.trouble.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        trouble.map_or(Ok(()), Err)
    }

    /// Records an error, if it is the first.
    pub fn keep(&self, shown: Result<(), CliError>) {
        if let Err(error) = shown {
            let mut trouble = self.trouble.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            trouble.get_or_insert(error);
        }
    }
}

impl Progress for TerminalProgress<'_> {
    fn stage(&self, what: &str) {
        if self.staged {
            count(&self.bar, false);
        }
        self.show(|[stage, _]| *stage = what.to_owned());
    }

    fn so_far(&self, answer: &str) {
        self.show(|[_, so_far]| *so_far = format!("best so far: {answer}"));
    }

    fn update(&self, done: u64, total: u64) {
        if self.staged {
            count(&self.bar, total > 0);
        }
        if self.staged {
            self.bar.set_length(total);
        } else {
            size(&self.bar, total);
        }
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
