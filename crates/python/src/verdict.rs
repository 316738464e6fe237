//! Verdicts and the replays behind them.

use std::sync::Arc;

use numpy::PyArray2;
use pushplan::files::PlanFile;
use pushplan::outcomes::{Evidence, Perturbation};
use pushplan::{Task, Verdict, Warning};
use pushplan_report::{
    Origin, PageView, TaskSource, replay_warnings, verdict_document, verdict_page,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;
use serde_json::json;

use crate::trajectory::PyTrajectory;
use crate::{arguments, arrays, json, page};

/// Verdict on a plan after nominal and perturbed replays in the 2-D and the 3-D engine.
#[pyclass(name = "Verdict", module = "pushplan", frozen)]
pub struct PyVerdict {
    /// Plan that was replayed.
    pub file: PlanFile,
    pub verdict: Verdict,
}

#[pymethods]
impl PyVerdict {
    /// Whether the plan violates no rule of its task and its nominal replays in both engines reach
    /// the goal at rest. The required share of the perturbed replays must also reach it.
    #[getter]
    fn passed(&self) -> bool {
        self.verdict.passed
    }

    /// Whether the nominal replays reach the goal, even if too few perturbed replays do.
    #[getter]
    fn nominal_ok(&self) -> bool {
        self.verdict.nominal_ok()
    }

    /// Share of the perturbed replays that reach the goal, 0 to 1, in the engine with the lower
    /// share; `None` without perturbed replays.
    #[getter]
    fn robustness(&self) -> Option<f64> {
        self.verdict.robustness
    }

    /// Verdict with its reason, one sentence.
    #[getter]
    fn reason(&self) -> String {
        let json = verdict_document(&self.file, &self.verdict).json;
        json["reason"].as_str().unwrap_or_default().to_owned()
    }

    /// Warnings of the nominal replays.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        replay_warnings(&self.verdict)
    }

    /// Replays, the nominal ones first.
    #[getter]
    fn replays(&self) -> Vec<PyReplay> {
        let task = Arc::new(self.file.task.clone());
        let replay =
            |evidence: &Evidence| PyReplay { task: task.clone(), evidence: evidence.clone() };
        self.verdict.evidence.iter().map(replay).collect()
    }

    /// Returns the verdict with the keys of `pushplan verify --json`.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::text(py, &verdict_document(&self.file, &self.verdict).to_json())
    }

    /// Returns the interactive report: one HTML file that plays the replays offline.
    fn page(&self) -> String {
        let task = TaskSource::File(format!("{}.yaml", self.file.task.name));
        let recipe = Origin { task, ..Origin::default() }.plan(&self.file.plan);
        verdict_page(&self.file, None, &self.verdict, recipe, PageView::Above)
    }

    /// Restores a verdict from the text that pickle stores.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        let mut kept = json::kept(text)?;
        let file = PlanFile::parse(&kept["file"].to_string(), "plan.json");
        let file = file.map_err(|faults| PyValueError::new_err(faults.to_string()))?;
        let verdict = serde_json::from_value(kept["verdict"].take()).map_err(json::damaged)?;
        Ok(Self { file, verdict })
    }

    /// Omits the frames of the replays; `verify` computes them again.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::unpickled(py, "Verdict", &self.kept())
    }

    // Frames follow from the plan, so they are ignored in comparisons.
    fn __eq__(&self, other: &Self) -> bool {
        self.kept() == other.kept()
    }

    fn _repr_html_(&self) -> String {
        page::frame(&self.page())
    }

    fn __str__(&self) -> String {
        verdict_document(&self.file, &self.verdict).to_text()
    }

    fn __repr__(&self) -> String {
        format!("<Verdict {}>", self.reason())
    }
}

impl PyVerdict {
    /// Returns the data that pickle stores.
    fn kept(&self) -> serde_json::Value {
        json!({"file": self.file, "verdict": self.verdict})
    }
}

/// Replay of a plan in one engine.
#[pyclass(name = "Replay", module = "pushplan", frozen)]
pub struct PyReplay {
    task: Arc<Task>,
    evidence: Evidence,
}

#[pymethods]
impl PyReplay {
    /// Engine of the replay: `"planar"` (2-D) or `"3d"`.
    #[getter]
    fn engine(&self) -> &'static str {
        arguments::engine(self.evidence.engine)
    }

    /// Number of the perturbation, from 1, equal in both engines; `None` for a nominal replay.
    #[getter]
    fn draw(&self) -> Option<usize> {
        match self.evidence.perturbation {
            Perturbation::Nominal => None,
            Perturbation::Perturbed { draw } => Some(draw),
        }
    }

    /// Final distance of the goal's object from the goal, metres.
    #[getter]
    fn error(&self) -> f64 {
        self.evidence.outcome.error()
    }

    /// Final heading error, radians; `None` if the goal states no heading.
    #[getter]
    fn heading_error(&self) -> Option<f64> {
        self.evidence.outcome.heading_error()
    }

    /// Whether the objects rest at the goal and no failure occurred before, such as a fall.
    #[getter]
    fn reached(&self) -> bool {
        self.evidence.outcome.reached
    }

    /// Final poses of all objects, `[objects, 3]`: x and y in metres, heading in radians.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::poses(py, &self.evidence.outcome.state.poses)
    }

    /// Largest sustained force of the tool, newtons, to within a factor of two; `None` if unknown.
    #[getter]
    fn force(&self) -> Option<f64> {
        self.evidence.force.map(|force| force.lasting)
    }

    /// Warnings of the replay, such as a toppled object.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.evidence.warnings.iter().map(Warning::to_string).collect()
    }

    /// Motion, frame by frame; `None` for a perturbed replay.
    #[getter]
    fn trajectory(&self) -> Option<PyTrajectory> {
        let trajectory = self.evidence.trajectory.clone()?;
        Some(PyTrajectory::new(&self.task, trajectory))
    }

    fn __repr__(&self) -> String {
        let reached = if self.reached() { "reached" } else { "not reached" };
        let how = self.draw().map_or("nominal".to_owned(), |draw| format!("perturbation {draw}"));
        format!(
            "<Replay {} {how}: goal {reached}, error {:.2} mm>",
            self.engine(),
            1e3 * self.error()
        )
    }
}
