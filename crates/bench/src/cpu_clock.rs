//! Processor time of the present thread.

use std::time::Duration;

/// Returns the time that this thread has spent on a processor so far, if the system reports it.
///
/// It is the first number of the kernel's `schedstat`, nanoseconds.
pub fn thread_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}
