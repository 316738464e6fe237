//! Processor time of a piece of work.

use std::time::{Duration, Instant};

use pushplan_bench::thread_time;

/// Runs `work` and returns the processor time that this thread spent on it, so that other work on
/// the machine does not count. Returns wall-clock time outside Linux, where the system does not
/// report processor time.
pub fn processor_time(work: impl FnOnce()) -> Duration {
    timed(work).1
}

/// Runs `work` and returns its result with the processor time, see [`processor_time`].
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let (before, began) = (thread_time(), Instant::now());
    let done = work();
    let wall = began.elapsed();
    let spent = match (before, thread_time()) {
        (Some(before), Some(after)) => after.saturating_sub(before),
        _ => wall,
    };
    (done, spent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sleeping_costs_no_processor_time_and_working_does() {
        if thread_time().is_none() {
            return;
        }
        let asleep = processor_time(|| std::thread::sleep(Duration::from_millis(60)));
        assert!(asleep < Duration::from_millis(30), "{asleep:?}");
        let busy = processor_time(|| {
            let began = Instant::now();
            while thread_time().is_some() && began.elapsed() < Duration::from_millis(60) {}
        });
        assert!(busy > Duration::from_millis(1), "{busy:?}");
    }
}
