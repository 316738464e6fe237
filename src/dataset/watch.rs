//! How a caller follows, and stops, a long job.

/// Follows a long job of many units: episodes, or tasks of a benchmark. Called from many threads.
pub trait Watch: Sync {
    /// `done` of `total` units are finished.
    fn progress(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// Something a person should know, such as a damaged file that is made again.
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
