//! What a piece of work costs: wall time, and processor time where one thread does it all.

use std::time::Instant;

use super::super::cpu_clock::thread_time;

/// Ends the names of processor times.
pub const PROCESSOR: &str = "_processor";

/// Time spent, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spent {
    /// On the wall.
    pub wall: f64,
    /// On the processor, if the present pool has one thread and the system tells: other work on
    /// the machine does not count.
    pub processor: Option<f64>,
}

impl Spent {
    /// Does `work` and says what it took.
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

    /// This on top of what was spent before; the processor's time only if it was always known,
    /// or nothing was spent before.
    pub fn after(self, before: Self) -> Self {
        let known = before.processor.or((before.wall == 0.0).then_some(0.0));
        let processor = self.processor.and_then(|time| Some(time + known?));
        Self { wall: self.wall + before.wall, processor }
    }
}
