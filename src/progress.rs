//! Progress and cancellation of long jobs.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// A clock that also works in browsers.
pub use web_time::Instant;

/// A progress observer that can cancel a long job.
///
/// Every long job reports to this trait: solving, benchmarks, data, training. Its methods are
/// called from many threads; each has an empty default.
pub trait Progress: Sync {
    /// Reports the current activity, such as a stage of solving or a task of a benchmark.
    fn stage(&self, what: &str) {
        let _ = what;
    }

    /// Reports that `done` of `total` units of the stage are finished.
    fn update(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// Reports the best answer so far in one line, whenever there is a better one.
    fn so_far(&self, answer: &str) {
        let _ = answer;
    }

    /// Reports a first result in one line, long before the last one.
    fn line(&self, text: &str) {
        let _ = text;
    }

    /// Reports a condition that the user should see, such as a damaged record that is rebuilt.
    fn note(&self, message: &str) {
        let _ = message;
    }

    /// Returns `true` if the job should stop; called before every unit.
    fn cancelled(&self) -> bool {
        false
    }
}

/// An observer that ignores reports and never cancels.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoProgress;

impl Progress for NoProgress {}

/// An observer that forwards cancellation only, because reports of many parallel jobs would be
/// noise.
pub struct Quiet<'a>(pub &'a dyn Progress);

impl Progress for Quiet<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// A thread-safe counter of the finished units of a stage.
pub struct Count<'a> {
    progress: &'a dyn Progress,
    done: AtomicU64,
    total: u64,
}

impl<'a> Count<'a> {
    /// Reports to `progress` that `done` of `total` units are finished, and then every further unit.
    pub fn new(progress: &'a dyn Progress, done: usize, total: usize) -> Self {
        let (done, total) = (done as u64, total as u64);
        progress.update(done, total);
        Self { progress, done: AtomicU64::new(done), total }
    }

    /// Counts one more finished unit.
    pub fn one(&self) {
        self.progress.update(self.done.fetch_add(1, Ordering::Relaxed) + 1, self.total);
    }
}

/// A cancellation handle: a job that watches it stops when any clone is cancelled.
///
/// ```
/// use pushplan::progress::{Cancel, Progress};
///
/// let cancel = Cancel::default();
/// let handle = cancel.clone();
/// std::thread::spawn(move || handle.cancel()).join().unwrap();
/// assert!(cancel.cancelled());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Requests cancellation of the job.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Progress for Cancel {
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// An observer that forwards to another one and cancels at a deadline.
pub struct Until<'a> {
    progress: &'a dyn Progress,
    end: Option<Instant>,
}

impl<'a> Until<'a> {
    /// Forwards to `progress` for at most `limit` from now.
    pub fn new(progress: &'a dyn Progress, limit: Option<Duration>) -> Self {
        // A limit beyond the range of the clock is no limit.
        Self { progress, end: limit.and_then(|limit| Instant::now().checked_add(limit)) }
    }
}

impl Progress for Until<'_> {
    fn stage(&self, what: &str) {
        self.progress.stage(what);
    }

    fn update(&self, done: u64, total: u64) {
        self.progress.update(done, total);
    }

    fn so_far(&self, answer: &str) {
        self.progress.so_far(answer);
    }

    fn line(&self, text: &str) {
        self.progress.line(text);
    }

    fn note(&self, message: &str) {
        self.progress.note(message);
    }

    fn cancelled(&self) -> bool {
        self.progress.cancelled() || self.end.is_some_and(|end| Instant::now() >= end)
    }
}
