//! Proposed tools.

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
use crate::{arguments, errors, json, work};

/// Result of `design`: the proposed tool, and the solution with the existing tools.
#[pyclass(name = "Design", module = "pushplan", frozen)]
pub struct PyDesign {
    task: Arc<Task>,
    source: TaskSource,
    design: Design,
}

#[pymethods]
impl PyDesign {
    /// Status with the proposed tool, or with the existing tools if there is no proposal; see
    /// `Solution.status` for the values.
    #[getter]
    fn status(&self) -> &'static str {
        arguments::status(self.design.status())
    }

    /// Proposed tool; the nearest one if no tool solves the task. `None` if no proposal is better
    /// than the existing tools.
    #[getter]
    fn tool(&self) -> Option<PyTool> {
        self.design.proposal.as_ref().map(|proposal| PyTool(Arc::clone(&proposal.tool)))
    }

    /// Solution with the proposed tool; `None` without a proposal.
    #[getter]
    fn solution(&self) -> Option<PySolution> {
        self.design.proposal.as_ref().map(|proposal| self.solved(&proposal.solution))
    }

    /// Solution with all existing tools, also with tools that the task does not name.
    #[getter]
    fn known(&self) -> PySolution {
        self.solved(&self.design.known)
    }

    /// Returns the design with the keys of `pushplan design --json`; times are wall-clock
    /// seconds.
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

/// Proposes a tool of cuboids for a pushing task.
///
/// The tool solves a task that no tool of `tools` solves, or solves it with a larger margin. Its
/// plan is verified like any other.
///
/// Parameters
/// ----------
/// task : Task
///     Task that the tool should solve.
/// tools : ToolLibrary, optional
///     Existing tools; by default the tools shipped with the package.
/// parts : int, default 3
///     Maximum number of parts of the tool.
/// candidates : int, default 1000
///     Number of screened tools, 1 to 1000000.
/// time_limit : float, optional
///     Seconds after which the best proposal so far is returned.
/// effort, seed, threads
///     Options of the planner, see `solve`.
///
/// Returns
/// -------
/// Design
///     Proposal, and the solution with the existing tools.
///
/// Raises
/// ------
/// FileError, TaskError or ValueError
///     If the task or an argument is invalid.
///
/// Examples
/// --------
/// >>> design = pushplan.design(task, candidates=200)
/// >>> tools = pushplan.ToolLibrary.shipped().with_tool(design.tool)
#[pyfunction]
#[pyo3(signature = (task, tools = None, *, parts = 3, candidates = 1000, effort = "standard",
                    seed = 0, time_limit = None, threads = 0))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn design(
    py: Python<'_>,
    task: &PyTask,
    tools: Option<Py<PyToolLibrary>>,
    parts: usize,
    candidates: usize,
    effort: &str,
    seed: u64,
    time_limit: Option<f64>,
    threads: usize,
) -> PyResult<PyDesign> {
    let most = DesignSettings::MOST_PARTS;
    if !(1..=most).contains(&parts) || !(1..=1_000_000).contains(&candidates) {
        let message = format!(
            "`parts` must be 1 to {most} and `candidates` 1 to 1000000, found {parts} and \
             {candidates}"
        );
        return Err(PyValueError::new_err(message));
    }
    let (model, replays, fit) = (None, None, None);
    let asked = Asked { effort, model, out_of_range: "warn", seed, replays, time_limit, fit };
    let planner = asked.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let settings = DesignSettings { parts, ..DesignSettings::looking_at(candidates) };
    let (stated, threads) = (Arc::clone(&task.task), arguments::threads(threads)?);
    let designed = work::run(py, threads, |cancel| {
        pushplan_design::design(&planner, &stated, &library, &settings, cancel)
    })?;
    let design = designed.map_err(|error| errors::solve(py, &error))?;
    Ok(PyDesign { task: stated, source: task.source(), design })
}
