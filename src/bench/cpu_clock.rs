//! How much processor time the present thread has used.

use std::time::{Duration, Instant};

/// Runs `work` and says how much processor time this thread spent on it, so that other work on the
/// machine does not count. Where the system does not say (outside Linux), wall-clock time.
pub fn processor_time(work: impl FnOnce()) -> Duration {
    timed(work).1
}

/// The same with what the work gives.
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

/// Time that this thread has spent on a processor so far, where the system tells.
///
/// The first number of the kernel's `schedstat`, nanoseconds.
pub fn thread_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
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
