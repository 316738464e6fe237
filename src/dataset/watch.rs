//! How a caller follows, and stops, a generation.

/// Follows a long generation. Called from many threads.
pub trait Watch: Sync {
    /// `done` of `total` episodes are finished.
    fn progress(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// Something a person should know, such as a damaged file that is made again.
    fn note(&self, message: &str) {
        let _ = message;
    }

    /// Whether to stop; asked before every episode.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Nobody follows and nothing stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {}
