//! Result of `solve`.

use std::sync::Arc;

use pushplan::outcomes::warning_lines;
use pushplan::{PlanStatus, RankedPlan, Situation, Solution, TableFit, Task};
use pushplan_report::{Origin, PageView, TaskSource, solution_document, solution_page};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;
use serde_json::json;

use crate::plan::PyPlan;
use crate::task::PyTask;
use crate::{arguments, json, page, work};

/// Result of `solve`: status, ranked plans and statistics of the search.
#[pyclass(name = "Solution", module = "pushplan", frozen)]
pub struct PySolution {
    pub task: Arc<Task>,
    pub source: TaskSource,
    pub solution: Solution,
    /// Table fit used by the planner.
    pub fit: Option<TableFit>,
}

#[pymethods]
impl PySolution {
    /// Status of the solution.
    ///
    /// - `"solved"`: the first plan passes verification.
    /// - `"fragile"`: the first plan passes its nominal replays, but too few perturbed replays.
    /// - `"partial"`: the first plan passes for some of several goals.
    /// - `"no_plan"`: no candidate comes near enough to the goal; the first plan is the nearest.
    /// - `"failed_verification"`: every plan that the planner replayed was rejected.
    #[getter]
    fn status(&self) -> &'static str {
        arguments::status(self.solution.status)
    }

    /// Whether the first plan passes verification.
    #[getter]
    fn solved(&self) -> bool {
        self.solution.status == PlanStatus::Solved
    }

    /// Whether the time limit ended the search early; the plans are then the best found so far.
    #[getter]
    fn timed_out(&self) -> bool {
        self.solution.stopped
    }

    /// Plan to use: the verified plan if solved, otherwise the nearest one. `None` only if no push
    /// is feasible.
    #[getter]
    fn best(&self) -> Option<PyPlan> {
        self.solution.best().map(|best| self.plan(best))
    }

    /// Ranked plans, best first.
    #[getter]
    fn plans(&self) -> Vec<PyPlan> {
        self.solution.plans.iter().map(|ranked| self.plan(ranked)).collect()
    }

    /// Task of the solution.
    #[getter]
    fn task(&self) -> PyTask {
        PyTask { task: Arc::clone(&self.task), source: Some(self.source.clone()) }
    }

    /// Warnings about the predictions of the first plan, most useful first.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        warning_lines(&self.solution.warnings)
    }

    /// Cause of a missing or failed plan and its remedy; `None` if there is a plan or no cause was
    /// found.
    #[getter]
    fn cause(&self) -> Option<String> {
        self.solution.cause.as_ref().map(ToString::to_string)
    }

    /// Returns the solution with the keys of `pushplan solve --json`; times are wall-clock
    /// seconds.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::text(py, &solution_document(&self.task, &self.solution).to_json())
    }

    /// Returns the interactive report: one HTML file that plays the plans offline. It also states
    /// why the planner rejected other plans.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let Self { task, solution, source, .. } = self;
        let Some(best) = solution.best() else {
            return Ok(solution_document(task, solution).to_html());
        };
        let situation = Situation::stated(&task.scene);
        let replays = work::run(py, 0, |_| best.replays(task, &situation))?;
        let recipe = |ranked: &RankedPlan| {
            let model = Some(ranked.predicted.by.clone());
            let task = source.clone();
            Origin { task, model, ..Origin::default() }.plan(&ranked.plan)
        };
        Ok(solution_page(task, solution, &replays, &recipe, PageView::Above))
    }

    /// Restores a solution from the text that pickle stores.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        let mut kept = json::kept(text)?;
        let mut take = |key: &str| kept[key].take();
        let source = serde_json::from_value(take("source")).map_err(json::damaged)?;
        let task = Task::parse(take("task").as_str().unwrap_or_default(), "task");
        let task = task.map_err(|faults| PyValueError::new_err(faults.to_string()))?;
        let solution = serde_json::from_value(take("solution")).map_err(json::damaged)?;
        let fit = serde_json::from_value(take("fit")).map_err(json::damaged)?;
        Ok(Self { task: Arc::new(task), source, solution, fit })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::unpickled(py, "Solution", &self.kept())
    }

    /// Compares everything except computing times.
    fn __eq__(&self, other: &Self) -> bool {
        let timeless = |one: &Self| {
            let mut kept = one.kept();
            kept["solution"]["statistics"]["timing"].take();
            kept
        };
        timeless(self) == timeless(other)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        Ok(page::frame(&self.page(py)?))
    }

    fn __str__(&self) -> String {
        solution_document(&self.task, &self.solution).to_text()
    }

    fn __repr__(&self) -> String {
        format!("<Solution {}>", solution_document(&self.task, &self.solution).title)
    }
}

impl PySolution {
    /// Returns the data that pickle stores.
    fn kept(&self) -> serde_json::Value {
        let Self { task, source, solution, fit } = self;
        json!({
            "task": task.to_json().to_string(), "source": source, "solution": solution,
            "fit": fit,
        })
    }

    fn plan(&self, ranked: &RankedPlan) -> PyPlan {
        PyPlan::ranked((&self.task, &self.source), self.fit.as_ref(), ranked)
    }
}
