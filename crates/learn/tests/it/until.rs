//! Progress observer that cancels.

use std::sync::atomic::{AtomicU64, Ordering};

use pushplan::progress::Progress;

/// Cancels once this many steps or episodes are done.
pub struct Until {
    wanted: u64,
    done: AtomicU64,
}

impl Until {
    /// Creates an observer without progress.
    pub fn new(wanted: u64) -> Self {
        Self { wanted, done: AtomicU64::new(0) }
    }
}

impl Progress for Until {
    fn update(&self, done: u64, _: u64) {
        self.done.fetch_max(done, Ordering::SeqCst);
    }

    fn cancelled(&self) -> bool {
        self.done.load(Ordering::SeqCst) >= self.wanted
    }
}
