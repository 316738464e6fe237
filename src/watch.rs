//! How a caller follows, and stops, a long job.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// A clock that browsers have, too.
pub use web_time::Instant;

/// Follows a long job and stops it. The one trait for everything that takes a while: solving,
/// benchmarks, data, training. Called from many threads; a method that is not needed can be left
/// out.
pub trait Watch: Sync {
    /// What is being done now, such as a stage of solving or a task of a benchmark.
    fn stage(&self, what: &str) {
        let _ = what;
    }

    /// `done` of `total` units of the stage are finished.
    fn progress(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// The best answer so far, one line, whenever there is a better one.
    fn so_far(&self, answer: &str) {
        let _ = answer;
    }

    /// A first result, one line, long before the last one.
    fn line(&self, text: &str) {
        let _ = text;
    }

    /// Something that people should know, such as a damaged record that is made again.
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

/// Forwards cancellation alone: many jobs run side by side, and reports of each would be noise.
pub struct Quiet<'a>(pub &'a dyn Watch);

impl Watch for Quiet<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

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

/// Stops a job from another thread: whoever holds a clone can.
///
/// ```
/// use pushplan::watch::{Cancel, Watch};
///
/// let cancel = Cancel::default();
/// let handle = cancel.clone();
/// std::thread::spawn(move || handle.cancel()).join().unwrap();
/// assert!(cancel.cancelled());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Asks the job to stop.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Watch for Cancel {
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Follows as another does, and stops when a time is over.
pub struct Until<'a> {
    watch: &'a dyn Watch,
    end: Option<Instant>,
}

impl<'a> Until<'a> {
    /// Like `watch`, for at most `limit` from now.
    pub fn new(watch: &'a dyn Watch, limit: Option<Duration>) -> Self {
        // A limit beyond the range of the clock is no limit.
        Self { watch, end: limit.and_then(|limit| Instant::now().checked_add(limit)) }
    }
}

impl Watch for Until<'_> {
    fn stage(&self, what: &str) {
        self.watch.stage(what);
    }

    fn progress(&self, done: u64, total: u64) {
        self.watch.progress(done, total);
    }

    fn so_far(&self, answer: &str) {
        self.watch.so_far(answer);
    }

    fn line(&self, text: &str) {
        self.watch.line(text);
    }

    fn note(&self, message: &str) {
        self.watch.note(message);
    }

    fn cancelled(&self) -> bool {
        self.watch.cancelled() || self.end.is_some_and(|end| Instant::now() >= end)
    }
}
