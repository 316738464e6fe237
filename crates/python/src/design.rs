//! Proposals of tools.

use std::sync::Arc;

use pushplan::{Solution, Task};
use pushplan_design::{Design, DesignSettings};
use pushplan_report::{TaskSource, design_document};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::solution::PySolution;
use crate::solve::Asked;
use crate::task::PyTask;
use crate::tool::{PyTool, PyToolLibrary, given};
use crate::{errors, json, words, work};

/// A tool that was proposed for a task, and what existing tools make of it.
#[pyclass(name = "Design", module = "pushplan", frozen)]
pub struct PyDesign {
    task: Arc<Task>,
    source: TaskSource,
    design: Design,
}

#[pymethods]
impl PyDesign {
    /// How well the task can be solved, in the words of `Solution.status`: with the tool that is
    /// proposed, or else with those that there are.
    #[getter]
    fn status(&self) -> &'static str {
        words::status(self.design.status())
    }

    /// The tool; `None` where none was found that does better than those that there are. Where no
    /// tool works it is the nearest.
    #[getter]
    fn tool(&self) -> Option<PyTool> {
        self.design.proposal.as_ref().map(|proposal| PyTool(Arc::clone(&proposal.tool)))
    }

    /// The task solved with the tool that is proposed; `None` without one.
    #[getter]
    fn solution(&self) -> Option<PySolution> {
        self.design.proposal.as_ref().map(|proposal| self.solved(&proposal.solution))
    }

    /// The task solved with existing tools, whichever it names.
    #[getter]
    fn known(&self) -> PySolution {
        self.solved(&self.design.known)
    }

    /// Everything, in the keys of `pushplan design --json`; times are wall-clock seconds.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::text(py, &design_document(&self.task, &self.design).to_json())
    }

    fn __str__(&self) -> String {
        design_document(&self.task, &self.design).to_text()
    }

    fn __repr__(&self) -> String {
        format!("<Design {}>", design_document(&self.task, &self.design).title)
    }
}

impl PyDesign {
    fn solved(&self, solution: &Solution) -> PySolution {
        let (task, source) = (Arc::clone(&self.task), self.source.clone());
        PySolution { task, source, solution: solution.clone(), fit: None }
    }
}

/// Proposes a tool of cuboids for a task of pushing: one that solves what none of `tools` does, or
/// that does so with more margin, verified like any other.
///
/// `tools` are by default those that come with the package; `parts` is the most parts that it may
/// have; `candidates` is the number of tools that are looked at; `effort`, `seed` and `threads` are
/// those of `solve`.
#[pyfunction]
#[pyo3(signature = (task, tools = None, *, parts = 3, candidates = 1000, effort = "standard",
                    seed = 0, threads = 0))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn design(
    py: Python<'_>,
    task: &PyTask,
    tools: Option<Py<PyToolLibrary>>,
    parts: usize,
    candidates: usize,
    effort: &str,
    seed: u64,
    threads: usize,
) -> PyResult<PyDesign> {
    let most = DesignSettings::MOST_PARTS;
    if !(1..=most).contains(&parts) || !(1..=1_000_000).contains(&candidates) {
        let message = format!("`parts` is from 1 to {most}, and `candidates` from 1 to 1000000");
        return Err(PyValueError::new_err(message));
    }
    let (model, disturbed, time_limit, fit) = (None, None, None, None);
    let asked = Asked { effort, model, outside: "warn", seed, disturbed, time_limit, fit };
    let planner = asked.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let settings = DesignSettings { parts, ..DesignSettings::looking_at(candidates) };
    let (stated, threads) = (Arc::clone(&task.task), words::threads(threads)?);
    let designed = work::run(py, threads, |cancel| {
        pushplan_design::design(&planner, &stated, &library, &settings, cancel)
    })?;
    let design = designed.map_err(|error| errors::solve(py, &error))?;
    Ok(PyDesign { task: stated, source: task.source(), design })
}
