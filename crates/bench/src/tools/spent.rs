//! Cost of computations: wall time, and processor time of single-threaded work.

use std::time::Instant;

use super::super::cpu_clock::thread_time;

/// Suffix of the names of processor times.
pub const PROCESSOR: &str = "_processor";

/// Time spent, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spent {
    /// Wall time.
    pub wall: f64,
    /// Processor time, if the current pool has one thread and the system reports it. It does not
    /// include other work on the machine.
    pub processor: Option<f64>,
}

impl Spent {
    /// Runs `work` and returns its result and cost.
    pub fn on<T>(work: impl FnOnce() -> T) -> (T, Self) {
        let alone = rayon::current_num_threads() == 1;
        let (before, began) = (thread_time().filter(|_| alone), Instant::now());
        let done = work();
        let wall = began.elapsed().as_secs_f64();
        let processor = before
            .and_then(|before| Some(thread_time()?.saturating_sub(before)))
            .map(|time| time.as_secs_f64());
        (done, Self { wall, processor })
    }

    /// Adds the cost spent before. The processor time is known only if both are known, or nothing
    /// was spent before.
    pub fn after(self, before: Self) -> Self {
        let known = before.processor.or((before.wall == 0.0).then_some(0.0));
        let processor = self.processor.and_then(|time| Some(time + known?));
        Self { wall: self.wall + before.wall, processor }
    }
}
