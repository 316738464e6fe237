//! A watcher that says to stop.

use std::sync::atomic::{AtomicU64, Ordering};

use pushplan::watch::Watch;

/// Says to stop once this much is done: steps, or episodes.
pub struct Until {
    wanted: u64,
    done: AtomicU64,
}

impl Until {
    /// Nothing is done yet.
    pub fn new(wanted: u64) -> Self {
        Self { wanted, done: AtomicU64::new(0) }
    }
}

impl Watch for Until {
    fn progress(&self, done: u64, _: u64) {
        self.done.fetch_max(done, Ordering::SeqCst);
    }

    fn cancelled(&self) -> bool {
        self.done.load(Ordering::SeqCst) >= self.wanted
    }
}
