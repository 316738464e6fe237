//! Progress of long work, reported to a Python function.

use std::sync::{Mutex, MutexGuard, PoisonError};

use pushplan::progress::{Cancel, Progress};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBool;

/// Cancellation and the last report of long work.
#[derive(Default)]
pub struct Watch {
    cancel: Cancel,
    report: Mutex<Report>,
}

#[derive(Clone, Default)]
struct Report {
    stage: String,
    done: u64,
    total: u64,
    best: String,
    /// Whether the caller lacks this report.
    fresh: bool,
}

impl Watch {
    /// Requests the end of the work.
    pub fn cancel(&self) {
        self.cancel.cancel();
    }

    fn report(&self) -> MutexGuard<'_, Report> {
        self.report.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self, change: impl FnOnce(&mut Report)) {
        let mut report = self.report();
        change(&mut report);
        report.fresh = true;
    }

    /// Returns the last report unless it was taken before.
    fn take(&self) -> Option<Report> {
        let mut report = self.report();
        std::mem::take(&mut report.fresh).then(|| report.clone())
    }
}

impl Progress for Watch {
    fn stage(&self, what: &str) {
        self.change(|report| {
            (report.stage, report.done, report.total) = (what.to_owned(), 0, 0);
        });
    }

    fn update(&self, done: u64, total: u64) {
        self.change(|report| (report.done, report.total) = (done, total));
    }

    fn so_far(&self, answer: &str) {
        self.change(|report| answer.clone_into(&mut report.best));
    }

    fn cancelled(&self) -> bool {
        self.cancel.cancelled()
    }
}

/// Receiver of the reports: a function of the caller, the line on stderr, or none.
#[derive(Default)]
pub struct Observer {
    function: Option<Py<PyAny>>,
    /// Whether `function` is the line on stderr.
    line: bool,
}

impl Observer {
    /// Converts the argument `progress`.
    pub fn of(py: Python<'_>, given: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let Some(given) = given else { return Ok(Self::default()) };
        if let Ok(switch) = given.cast::<PyBool>() {
            if !switch.is_true() {
                return Ok(Self::default());
            }
            let line = py.import("pushplan.progress")?.getattr("Line")?.call0()?;
            return Ok(Self { function: Some(line.unbind()), line: true });
        }
        if !given.is_callable() {
            return Err(PyTypeError::new_err(format!(
                "`progress` must be True or a function of one argument, a `pushplan.Progress`, \
                 found {}",
                given.repr()?
            )));
        }
        Ok(Self { function: Some(given.clone().unbind()), line: false })
    }

    /// Calls the function if there is a new report.
    pub fn look(&self, py: Python<'_>, watch: &Watch) -> PyResult<()> {
        let (Some(function), Some(report)) = (&self.function, watch.take()) else { return Ok(()) };
        let Report { stage, done, total, best, fresh: _ } = report;
        let class = py.import("pushplan.progress")?.getattr("Progress")?;
        function.call1(py, (class.call1((stage, done, total, best))?,))?;
        Ok(())
    }

    /// Reports the last change of finished work, and removes the line.
    pub fn end(&self, py: Python<'_>, finished: Option<&Watch>) -> PyResult<()> {
        let last = finished.map_or(Ok(()), |watch| self.look(py, watch));
        if let (Some(line), true) = (&self.function, self.line) {
            line.call_method0(py, "close")?;
        }
        last
    }
}
