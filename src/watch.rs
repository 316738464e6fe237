//! How a caller follows, and stops, a long job.

use std::sync::atomic::{AtomicU64, Ordering};

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

/// Counts the finished units of a stage, from any number of threads.
pub struct Count<'a> {
    watch: &'a dyn Watch,
    done: AtomicU64,
    total: u64,
}

impl<'a> Count<'a> {
    /// Tells `watch` that `done` of `total` units are finished, and every further one.
    pub fn new(watch: &'a dyn Watch, done: usize, total: usize) -> Self {
        let (done, total) = (done as u64, total as u64);
        watch.progress(done, total);
        Self { watch, done: AtomicU64::new(done), total }
    }

    /// One more is finished.
    pub fn one(&self) {
        self.watch.progress(self.done.fetch_add(1, Ordering::Relaxed) + 1, self.total);
    }
}
