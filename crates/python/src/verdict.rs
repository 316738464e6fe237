//! Verdicts and the replays behind them.

use std::sync::Arc;

use numpy::PyArray2;
use pushplan::asset::PlanFile;
use pushplan::outcome::{Evidence, Perturbation, Warning};
use pushplan::{Task, Verdict};
use pushplan_report::{
    Origin, PageView, TaskSource, replay_warnings, verdict_document, verdict_page,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;
use serde_json::json;

use crate::trajectory::PyTrajectory;
use crate::{arguments, arrays, json, page};

/// Whether a plan works when it is replayed in both engines, as written and disturbed.
#[pyclass(name = "Verdict", module = "pushplan", frozen)]
pub struct PyVerdict {
    /// Plan that was replayed.
    pub file: PlanFile,
    pub verdict: Verdict,
}

#[pymethods]
impl PyVerdict {
    /// Whether the plan breaks no rule of its task, reaches the goal at rest in both engines as
    /// written, and in the wanted share of the disturbed replays.
    #[getter]
    fn passed(&self) -> bool {
        self.verdict.passed
    }

    /// Whether it works as written, though perhaps too seldom under disturbances.
    #[getter]
    fn nominal_ok(&self) -> bool {
        self.verdict.nominal_ok()
    }

    /// Share of the disturbed replays that reach the goal, 0 to 1, in the engine in which fewer do;
    /// `None` if there was none.
    #[getter]
    fn robustness(&self) -> Option<f64> {
        self.verdict.robustness
    }

    /// The verdict and why, in a sentence.
    #[getter]
    fn reason(&self) -> String {
        let json = verdict_document(&self.file, &self.verdict).json;
        json["reason"].as_str().unwrap_or_default().to_owned()
    }

    /// What a reader should know about the replays as written.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        replay_warnings(&self.verdict)
    }

    /// All replays, those as written first.
    #[getter]
    fn replays(&self) -> Vec<PyReplay> {
        let task = Arc::new(self.file.task.clone());
        let replay =
            |evidence: &Evidence| PyReplay { task: task.clone(), evidence: evidence.clone() };
        self.verdict.evidence.iter().map(replay).collect()
    }

    /// Everything, in the keys of `pushplan verify --json`.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::text(py, &verdict_document(&self.file, &self.verdict).to_json())
    }

    /// A page that plays the replays: one HTML file, without server or network.
    fn page(&self) -> String {
        let task = TaskSource::File(format!("{}.yaml", self.file.task.name));
        let recipe = Origin { task, ..Origin::default() }.plan(&self.file.plan);
        verdict_page(&self.file, None, &self.verdict, recipe, PageView::Above)
    }

    /// Reads what pickle keeps.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        let mut kept = json::kept(text)?;
        let file = PlanFile::parse(&kept["file"].to_string(), "plan.json");
        let file = file.map_err(|faults| PyValueError::new_err(faults.to_string()))?;
        let verdict = serde_json::from_value(kept["verdict"].take()).map_err(json::damaged)?;
        Ok(Self { file, verdict })
    }

    /// Without the replays' frames, which replaying the plan gives again.
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

/// One replay of a plan in an engine.
#[pyclass(name = "Replay", module = "pushplan", frozen)]
pub struct PyReplay {
    task: Arc<Task>,
    evidence: Evidence,
}

#[pymethods]
impl PyReplay {
    /// `"planar"` or `"3d"`.
    #[getter]
    fn engine(&self) -> &'static str {
        arguments::engine(self.evidence.engine)
    }

    /// Number of the disturbance, from 1 and the same in both engines; `None` as written.
    #[getter]
    fn draw(&self) -> Option<usize> {
        match self.evidence.perturbation {
            Perturbation::Nominal => None,
            Perturbation::Perturbed { draw } => Some(draw),
        }
    }

    /// Distance of the goal's object from the goal at the end, metres.
    #[getter]
    fn error(&self) -> f64 {
        self.evidence.outcome.error()
    }

    /// Heading error at the end, radians, where a heading is asked for.
    #[getter]
    fn heading_error(&self) -> Option<f64> {
        self.evidence.outcome.heading_error()
    }

    /// Whether the goal is reached, at rest and with nothing gone wrong on the way.
    #[getter]
    fn reached(&self) -> bool {
        self.evidence.outcome.reached
    }

    /// Poses of all objects at the end, `[objects, 3]`: x and y in metres, heading in radians.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::poses(py, &self.evidence.outcome.state.poses)
    }

    /// Largest force of the tool that lasted, newtons; to within a factor of two.
    #[getter]
    fn force(&self) -> Option<f64> {
        self.evidence.force.map(|force| force.lasting)
    }

    /// What happened on the way.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.evidence.warnings.iter().map(Warning::to_string).collect()
    }

    /// What happened frame by frame, of a replay as written.
    #[getter]
    fn trajectory(&self) -> Option<PyTrajectory> {
        let trajectory = self.evidence.trajectory.clone()?;
        Some(PyTrajectory::new(&self.task, trajectory))
    }

    fn __repr__(&self) -> String {
        let reached = if self.reached() { "reached" } else { "not reached" };
        let how = self.draw().map_or("as written".to_owned(), |draw| format!("draw {draw}"));
        format!(
            "<Replay {} {how}: goal {reached}, off by {:.2} mm>",
            self.engine(),
            1e3 * self.error()
        )
    }
}
