//! Processor time of the current thread.

use std::time::Duration;

/// Returns the processor time used by this thread so far, if the system reports it.
///
/// The source is the first number of the kernel's `schedstat`, nanoseconds.
pub fn thread_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}
