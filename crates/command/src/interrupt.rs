//! Ctrl-C and termination signals.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::{error::CliError, exit_code};

static FLAGS: OnceLock<Flags> = OnceLock::new();

struct Flags {
    requested: Arc<AtomicBool>,
    /// Whether the next signal ends the process at once.
    abrupt: Arc<AtomicBool>,
}

/// Installs the handlers: a job that [`watch`]es is asked to stop at the first signal and save,
/// and is ended by the second; anything else ends at once. Files appear under their final name
/// only when they are whole, so ending at once loses nothing that was finished.
///
/// The hangup of a terminal keeps what it does: it ends the process, or under `nohup` nothing.
///
/// # Errors
/// [`CliError::Unexpected`] if the system refuses a handler.
pub fn install() -> Result<(), CliError> {
    let flags = Flags {
        requested: Arc::new(AtomicBool::new(false)),
        abrupt: Arc::new(AtomicBool::new(true)),
    };
    let (requested, abrupt) = (flags.requested.clone(), flags.abrupt.clone());
    // A second call in one process (tests, embedding) finds the handlers in place.
    if FLAGS.set(flags).is_err() {
        return Ok(());
    }
    for signal in [SIGINT, SIGTERM] {
        // In this order, so that the signal that sets `abrupt` is not the one that ends.
        flag::register_conditional_shutdown(signal, exit_code::INTERRUPTED.into(), abrupt.clone())
            .and_then(|_| flag::register(signal, abrupt.clone()))
            .and_then(|_| flag::register(signal, requested.clone()))
            .map_err(|error| CliError::unexpected("cannot watch for Ctrl-C", &error))?;
    }
    Ok(())
}

/// From here on the first signal asks to stop, which a long job sees between two units of work:
/// see [`requested`].
pub fn watch() -> &'static AtomicBool {
    static NEVER: AtomicBool = AtomicBool::new(false);
    FLAGS.get().map_or(&NEVER, |flags| {
        flags.abrupt.store(flags.requested.load(Ordering::SeqCst), Ordering::SeqCst);
        flags.requested.as_ref()
    })
}

/// Whether a watched job was asked to stop.
pub fn requested() -> bool {
    FLAGS.get().is_some_and(|flags| flags.requested.load(Ordering::SeqCst))
}
