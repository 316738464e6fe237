//! How a caller follows, and stops, a long job.

/// Follows a long job and stops it. The one trait for everything that takes a while: solving,
/// benchmarks, data, training. Called from many threads; whoever does not care about something
/// leaves it out.
pub trait Watch: Sync {
    /// What is being done now, such as a stage of solving or a task of a benchmark.
    fn stage(&self, what: &str) {
        let _ = what;
    }

    /// `done` of `total` units of the stage are finished.
    fn progress(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// A first result, one line, long before the last one.
    fn line(&self, text: &str) {
        let _ = text;
    }

    /// Something a person should know, such as a damaged record that is made again.
    fn note(&self, message: &str) {
        let _ = message;
    }

    /// Whether to stop; asked before every unit.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Nobody follows and nothing stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {}
