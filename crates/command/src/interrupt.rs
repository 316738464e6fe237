//! Handling of Ctrl-C and termination signals.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::{error::CliError, exit_code};

static FLAGS: OnceLock<Flags> = OnceLock::new();

struct Flags {
    requested: Arc<AtomicBool>,
    /// Whether the next signal ends the process immediately.
    abrupt: Arc<AtomicBool>,
}

/// Installs the signal handlers.
///
/// The first signal asks a job that polls [`watch`] to stop and save, and the second ends it. Other
/// commands end immediately. Files get their final names only when they are complete, so that no
/// finished work is lost.
///
/// The hangup of a terminal keeps its default: it ends the process, or does nothing under `nohup`.
///
/// # Errors
/// Returns [`CliError::Unexpected`] if the system refuses a handler.
pub fn install() -> Result<(), CliError> {
    let flags = Flags {
        requested: Arc::new(AtomicBool::new(false)),
        abrupt: Arc::new(AtomicBool::new(true)),
    };
    let (requested, abrupt) = (flags.requested.clone(), flags.abrupt.clone());
    // A second call in one process (tests, embedding) finds the handlers installed.
    if FLAGS.set(flags).is_err() {
        return Ok(());
    }
    for signal in [SIGINT, SIGTERM] {
        // The order ensures that the signal that sets `abrupt` does not end the process.
        flag::register_conditional_shutdown(signal, exit_code::INTERRUPTED.into(), abrupt.clone())
            .and_then(|_| flag::register(signal, abrupt.clone()))
            .and_then(|_| flag::register(signal, requested.clone()))
            .map_err(|error| CliError::unexpected("cannot watch for Ctrl-C", &error))?;
    }
    Ok(())
}

/// Starts graceful handling: from now on the first signal only requests a stop, which a long job
/// polls between two units of work, see [`requested`].
pub fn watch() -> &'static AtomicBool {
    static NEVER: AtomicBool = AtomicBool::new(false);
    FLAGS.get().map_or(&NEVER, |flags| {
        flags.abrupt.store(flags.requested.load(Ordering::SeqCst), Ordering::SeqCst);
        flags.requested.as_ref()
    })
}

/// Returns the exit code of work that ends with `code` unless a stop was requested.
pub fn code(code: u8) -> u8 {
    if requested() { exit_code::INTERRUPTED } else { code }
}

/// Returns `true` if a stop was requested.
pub fn requested() -> bool {
    FLAGS.get().is_some_and(|flags| flags.requested.load(Ordering::SeqCst))
}
