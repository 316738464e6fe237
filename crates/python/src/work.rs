//! Long work without the GIL, on a given number of threads, cancelled by Ctrl-C.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use pushplan::progress::Progress;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::progress::{Observer, Watch};

/// Interval between checks for Python signals and reports of progress.
const LOOK: Duration = Duration::from_millis(50);

/// Thread pools of a process by their number of threads; 0 stands for one per core.
type Pools = HashMap<usize, Arc<ThreadPool>>;

/// Thread pools with the process they belong to, because a forked child has none of its parent's
/// threads.
static POOLS: Mutex<Option<(u32, Pools)>> = Mutex::new(None);

/// Runs `work` on `threads` threads (0: one per core) while other Python threads continue. Ctrl-C
/// cancels the work; its result is then discarded and the exception returned.
pub fn run<T: Send>(
    py: Python<'_>,
    threads: usize,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<T> {
    follow(py, threads, &Observer::default(), work)
}

/// Runs `work` like [`run`], and reports its progress to `observer`. An exception of the observer
/// also cancels the work.
pub fn follow<T: Send>(
    py: Python<'_>,
    threads: usize,
    observer: &Observer,
    work: impl FnOnce(&Watch) -> T + Send,
) -> PyResult<T> {
    let pool = pool(threads)?;
    let watch = Watch::default();
    let done = py.detach(|| watched(&pool, &watch, observer, work));
    let done = done.unwrap_or_else(|panic| resume_unwind(panic));
    let ended = observer.end(py, done.is_ok().then_some(&watch));
    done.and_then(|done| ended.map(|()| done))
}

type Caught<T> = Result<T, Box<dyn std::any::Any + Send>>;

fn watched<T: Send>(
    pool: &ThreadPool,
    watch: &Watch,
    observer: &Observer,
    work: impl FnOnce(&Watch) -> T + Send,
) -> Caught<PyResult<T>> {
    let (sender, receiver) = channel();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            let done = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(watch))));
            // The receiver outlives this thread.
            let _ = sender.send(done);
        });
        let mut stopped = None;
        loop {
            match receiver.recv_timeout(LOOK) {
                Ok(done) => return done.map(|done| stopped.map_or(Ok(done), Err)),
                Err(RecvTimeoutError::Disconnected) => {
                    return Ok(Err(PyRuntimeError::new_err(
                        "the worker thread ended without a result; please report this as a bug",
                    )));
                }
                Err(RecvTimeoutError::Timeout) if watch.cancelled() => {}
                Err(RecvTimeoutError::Timeout) => {
                    let looked = Python::attach(|py| {
                        py.check_signals()?;
                        observer.look(py, watch)
                    });
                    if let Err(error) = looked {
                        watch.cancel();
                        stopped = Some(error);
                    }
                }
            }
        }
    })
}

fn pool(threads: usize) -> PyResult<Arc<ThreadPool>> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((owner, others)) = pools.take_if(|(owner, _)| *owner != process) {
        // Dropping the pools would wait for threads that do not exist in this process.
        std::mem::forget((owner, others));
    }
    let (_, pools) = pools.get_or_insert_with(|| (process, HashMap::new()));
    if let Some(pool) = pools.get(&threads) {
        return Ok(Arc::clone(pool));
    }
    let built = ThreadPoolBuilder::new().num_threads(threads).build();
    let built = built.map_err(|error| {
        PyRuntimeError::new_err(format!(
            "cannot start {threads} worker threads: {error}; choose fewer `threads`"
        ))
    })?;
    let pool = Arc::new(built);
    pools.insert(threads, Arc::clone(&pool));
    Ok(pool)
}
