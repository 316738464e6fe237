//! Ctrl-C and termination signals.

use std::sync::atomic::{AtomicBool, Ordering};

use super::{error::CliError, exit_code};

static REQUESTED: AtomicBool = AtomicBool::new(false);
static WATCHED: AtomicBool = AtomicBool::new(false);

/// Installs the handler: a job that [`watch`]es is asked to stop at the first signal and save,
/// and is ended by the second; anything else ends at once. Files appear under their final name
/// only when they are whole, so ending at once loses nothing that was finished.
///
/// # Errors
/// [`CliError::Unexpected`] if the system refuses the handler.
pub fn install() -> Result<(), CliError> {
    // A second call in one process (tests, embedding) finds the handler in place.
    match ctrlc::try_set_handler(stop) {
        Ok(()) | Err(ctrlc::Error::MultipleHandlers) => Ok(()),
        Err(error) => Err(CliError::unexpected("cannot watch for Ctrl-C", &error)),
    }
}

/// The flag that a long job looks at between two units of work.
pub fn watch() -> &'static AtomicBool {
    WATCHED.store(true, Ordering::SeqCst);
    &REQUESTED
}

/// Whether a watched job was asked to stop.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

fn stop() {
    if WATCHED.load(Ordering::SeqCst) && !REQUESTED.swap(true, Ordering::SeqCst) {
        return;
    }
    std::process::exit(i32::from(exit_code::INTERRUPTED));
}
