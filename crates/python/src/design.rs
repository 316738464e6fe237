//! Proposed tools.

use std::sync::Arc;
use std::time::Duration;

use pushplan::{Solution, Task};
use pushplan_design::{Design, DesignSettings};
use pushplan_report::{TaskSource, design_document};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::progress::Observer;
use crate::solution::PySolution;
use crate::solve::Asked;
use crate::task::PyTask;
use crate::tool::{PyTool, PyToolLibrary, given};
use crate::{arguments, errors, json, wanted, work};

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
/// progress : bool or callable, optional
///     Receiver of the stage and the number of screened tools, see `solve`.
///
/// Returns
/// -------
/// Design
///     Proposal, and the solution with the existing tools.
///
/// Raises
/// ------
/// FileError, TaskError, TypeError or ValueError
///     If the task or an argument is invalid.
///
/// Examples
/// --------
/// >>> design = pushplan.design(task, candidates=200)
/// >>> if design.tool is not None:
/// ...     tools = pushplan.ToolLibrary.shipped().with_tool(design.tool)
#[pyfunction]
#[pyo3(signature = (task, tools = None, *, parts = 3, candidates = 1000, effort = "standard",
                    seed = 0, time_limit = None, threads = 0, progress = None))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn design(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::task)] task: Py<PyTask>,
    #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    #[pyo3(from_py_with = arguments::parts)] parts: usize,
    #[pyo3(from_py_with = arguments::candidates)] candidates: usize,
    effort: &str,
    #[pyo3(from_py_with = arguments::seed)] seed: u64,
    #[pyo3(from_py_with = arguments::time_limit)] time_limit: Option<Duration>,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyDesign> {
    let (model, replays, fit) = (None, None, None);
    let asked = Asked { effort, model, out_of_range: "warn", seed, replays, time_limit, fit };
    let planner = asked.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let settings = DesignSettings { parts, ..DesignSettings::looking_at(candidates) };
    let (task, observer) = (task.get(), Observer::of(py, progress)?);
    let stated = Arc::clone(&task.task);
    let designed = work::follow(py, threads, &observer, |watch| {
        pushplan_design::design(&planner, &stated, &library, &settings, watch)
    })?;
    let design = designed.map_err(|error| errors::solve(py, &error))?;
    Ok(PyDesign { task: stated, source: task.source(), design })
}
