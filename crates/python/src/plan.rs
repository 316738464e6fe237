//! Plans: task, tools and pushes, with predictions and verdicts.

use std::path::PathBuf;
use std::sync::Arc;

use pushplan::asset::PlanFile;
use pushplan::solve::{ManualPush, manual_plan};
use pushplan::verify::{VerifySettings, broken_rules};
use pushplan::{Job, RankedPlan, Task, Trajectory, Verdict, Verifier};
use pushplan::{
    outcome::Warning,
    scene::{Engine, Situation, TableFit},
    task::PushForm,
};
use pushplan_export::mjcf;
use pushplan_report::{Graph, Origin, PageView, TaskSource, verdict_page};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::push::PyPush;
use crate::table_fit::PyTableFit;
use crate::task::PyTask;
use crate::tool::{PyTool, PyToolLibrary, tool};
use crate::trajectory::PyTrajectory;
use crate::verdict::PyVerdict;
use crate::{errors, json, page, work};

/// A task, a tool and pushes, with what is known about their effect.
///
/// A plan is complete: it can be predicted, verified, drawn and exported without any other file.
#[pyclass(name = "Plan", module = "pushplan", frozen)]
pub struct PyPlan {
    pub file: PlanFile,
    /// Source of the task.
    source: TaskSource,
    trajectory: Option<Trajectory>,
    broken: Vec<String>,
}

#[pymethods]
impl PyPlan {
    /// Reads a plan file (JSON). Raises `FileError` with all its faults.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let file = PlanFile::load(path).map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self::read(file))
    }

    /// Reads the text of a plan file; `name` names it in faults.
    #[staticmethod]
    #[pyo3(signature = (text, name = "plan"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        let file =
            PlanFile::parse(text, name).map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self::read(file))
    }

    /// The plan of these pushes with `tool` (or the one of that name in `tools`, by default those
    /// that come with the package), held with `grip_yaw` (radians from world +x), or with the first
    /// of the task's with which they can be made.
    ///
    /// Nothing is searched. A push that breaks a rule of the task is made all the same, see
    /// `broken`. Raises `ActionError` for pushes that cannot be made.
    #[staticmethod]
    #[pyo3(signature = (task, tool, pushes, *, grip_yaw = None, tools = None))]
    fn of(
        py: Python<'_>,
        task: &PyTask,
        tool: &Bound<'_, PyAny>,
        pushes: Vec<Py<PyPush>>,
        grip_yaw: Option<f64>,
        tools: Option<Py<PyToolLibrary>>,
    ) -> PyResult<Self> {
        let tool = self::tool(py, tool, tools.as_ref())?;
        let yaws = match grip_yaw {
            None => task.task.pushes.grip_yaws.clone(),
            Some(yaw) if yaw.is_finite() => vec![yaw],
            Some(_) => return Err(PyValueError::new_err("`grip_yaw` must be finite")),
        };
        let pushes: Vec<ManualPush> = pushes.iter().map(|push| push.get().0.clone()).collect();
        let situation = Situation::stated(&task.task.scene);
        let asked =
            work::run(py, 0, |_| manual_plan(&task.task, &situation, &tool, &yaws, &pushes))?;
        let asked = asked.map_err(|error| errors::action(py, &error.to_string()))?;
        let rules =
            broken_rules(&task.task, &task.task.scene, std::slice::from_ref(&tool), &asked.plan);
        let forms = rules.iter().filter(|rule| {
            matches!(rule, Warning::ForbiddenPush { .. } | Warning::TooManyPushes { .. })
        });
        let margins = asked.broken.iter().map(|(push, rule)| format!("push {}: {rule}", push + 1));
        let broken: Vec<String> = margins.chain(forms.map(Warning::to_string)).collect();
        let file = PlanFile::new(Task::clone(&task.task), vec![tool], asked.plan);
        Ok(Self { file, source: task.source(), trajectory: None, broken })
    }

    /// The task.
    #[getter]
    fn task(&self) -> PyTask {
        PyTask { task: Arc::new(self.file.task.clone()), source: Some(self.source.clone()) }
    }

    /// The first tool. A plan without steps, which only a file can hold, has none: `ValueError`.
    #[getter]
    fn tool(&self) -> PyResult<PyTool> {
        let first = self.file.tools.first().map(|tool| PyTool(Arc::clone(tool)));
        first.ok_or_else(|| PyValueError::new_err("a plan without steps has no tool"))
    }

    /// All tools, in the order in which they are used.
    #[getter]
    fn tools(&self) -> Vec<PyTool> {
        self.file.tools.iter().map(|tool| PyTool(Arc::clone(tool))).collect()
    }

    /// The steps in order, in the keys of a plan file: `{"push": ...}` or `{"lever_up": ...}`.
    #[getter]
    fn steps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let steps = serde_json::to_value(&self.file.plan.steps);
        json::dict(py, &steps.map_err(|error| PyRuntimeError::new_err(error.to_string()))?)
    }

    /// Whether it levers anything.
    #[getter]
    fn levers(&self) -> bool {
        self.file.plan.levers()
    }

    /// The pushes, in order.
    #[getter]
    fn pushes(&self) -> Vec<PyPush> {
        self.file.plan.pushes().iter().map(PyPush::from).collect()
    }

    /// Rotation of the end effector against world +x, radians.
    #[getter]
    fn grip_yaw(&self) -> f64 {
        self.file.plan.grip_yaw()
    }

    /// `"placed"`: the tool is lifted and set down for every push; `"chained"`: each push goes on
    /// where the last one ended.
    #[getter]
    fn form(&self) -> &'static str {
        match self.file.plan.form() {
            PushForm::Placed => "placed",
            PushForm::Chained => "chained",
        }
    }

    /// Height of the tool's underside above the table, metres.
    #[getter]
    fn lift(&self) -> f64 {
        self.file.plan.lift()
    }

    /// The effect model that predicted its end, if one did.
    #[getter]
    fn model(&self) -> Option<String> {
        self.file.model.as_ref().map(ToString::to_string)
    }

    /// What that model knew of the table, if anything.
    #[getter]
    fn fit(&self) -> Option<PyTableFit> {
        self.file.fit.clone().map(PyTableFit)
    }

    /// Distance of the goal's object from the goal as predicted, metres.
    #[getter]
    fn error(&self) -> Option<f64> {
        self.file.predicted.as_ref().map(|outcome| outcome.error())
    }

    /// What the model predicts frame by frame; only of plans that `solve` returns.
    #[getter]
    fn trajectory(&self) -> Option<PyTrajectory> {
        let trajectory = self.trajectory.clone()?;
        Some(PyTrajectory::new(&Arc::new(self.file.task.clone()), trajectory))
    }

    /// The graph that the network reads, between frames `frame` and `frame + 1` of `trajectory`: a
    /// dictionary with `nodes` (objects, the parts of the tool, obstacles: name, kind, pose, size, and
    /// how they move) and `relations` (contacts and joints between them, by the nodes' indices); `None`
    /// past the last frame, and where something is levered, several tools are used, or nothing was predicted.
    fn graph<'py>(&self, py: Python<'py>, frame: usize) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(trajectory) = &self.trajectory else { return Ok(None) };
        let PlanFile { task, plan, tools, .. } = &self.file;
        let flat = trajectory.frames.iter().all(|frame| frame.state.space.is_none());
        let slides = plan.slides(tools).filter(|_| flat);
        let Some([motion]) = slides.as_deref() else { return Ok(None) };
        let job = Job::stated(&task.scene, motion.clone());
        let graph = Graph::at(&task.scene, &job, trajectory, frame);
        let text = graph.map(|graph| serde_json::to_string(&graph)).transpose();
        match text.map_err(|error| PyValueError::new_err(error.to_string()))? {
            Some(text) => json::text(py, &text).map(Some),
            None => Ok(None),
        }
    }

    /// Whether replays confirm it, where that was tried.
    #[getter]
    fn verdict(&self) -> Option<PyVerdict> {
        let verdict = self.file.verdict.clone()?;
        Some(PyVerdict { file: self.file.clone(), verdict })
    }

    /// Rules of the task that its pushes break; plans that were searched for break none.
    #[getter]
    fn broken(&self) -> Vec<String> {
        self.broken.clone()
    }

    /// Writes the plan file, which the command `pushplan verify` and `Plan.load` read; a partial
    /// one is never left behind.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.file.write(path).map_err(|faults| errors::files(py, &faults, None))
    }

    /// The keys of its file.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::dict(py, &self.json()?)
    }

    /// The plan as a scene of MuJoCo (MJCF), pushes and goal included.
    pub fn to_mjcf(&self) -> PyResult<String> {
        mjcf(&self.file).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The plan page: one HTML file that plays the replays, without server or network. Missing
    /// replays are made now.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let recorded = |verdict: &Verdict| {
            let replays: Vec<_> =
                Engine::ALL.iter().filter_map(|engine| verdict.nominal(*engine)).collect();
            !replays.is_empty() && replays.iter().all(|replay| replay.trajectory.is_some())
        };
        let verdict = match &self.file.verdict {
            Some(verdict) if recorded(verdict) => verdict.clone(),
            _ => work::run(py, 0, |_| self.replayed())?,
        };
        let origin = Origin { task: self.source.clone(), ..Origin::default() };
        let recipe = origin.plan(&self.file.plan);
        Ok(verdict_page(&self.file, self.trajectory.as_ref(), &verdict, recipe, PageView::Above))
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        Ok(page::frame(&self.page(py)?))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::unpickled(py, "Plan", &self.json()?)
    }

    // Equal plans have equal files, which do not contain replays.
    fn __eq__(&self, other: &Self) -> PyResult<bool> {
        Ok(self.json()? == other.json()?)
    }

    fn __repr__(&self) -> String {
        let plan = &self.file.plan;
        let steps = match (plan.steps.len(), plan.levers()) {
            (1, false) => "1 push".to_owned(),
            (count, false) => format!("{count} pushes"),
            (1, true) => "1 lever-up".to_owned(),
            (count, true) => format!("{count} steps"),
        };
        let tools = match self.file.tools.is_empty() {
            true => "no tool".to_owned(),
            false => self.file.tools.iter().map(|tool| &*tool.name).collect::<Vec<_>>().join(", "),
        };
        format!("<Plan for {}: {steps} with {tools}>", self.file.task.name)
    }
}

impl PyPlan {
    /// Creates a plan from a ranked plan of a solution.
    pub fn ranked(
        (task, source): (&Task, &TaskSource),
        fit: Option<&TableFit>,
        ranked: &RankedPlan,
    ) -> Self {
        let file = PlanFile {
            task: task.clone(),
            tools: ranked.tools.clone(),
            plan: ranked.plan.clone(),
            model: Some(ranked.predicted.by.clone()),
            fit: fit.cloned(),
            predicted: Some(ranked.outcome.clone()),
            verdict: ranked.verdict.clone(),
            joints: ranked.joints.clone(),
        };
        let trajectory = Some(ranked.predicted.clone());
        Self { file, source: source.clone(), trajectory, broken: Vec::new() }
    }

    fn read(file: PlanFile) -> Self {
        let source = TaskSource::File(format!("{}.yaml", file.task.name));
        Self { file, source, trajectory: None, broken: Vec::new() }
    }

    /// Replays the unperturbed plan in both engines.
    fn replayed(&self) -> Verdict {
        let PlanFile { task, tools, plan, .. } = &self.file;
        let verifier = Verifier::new(VerifySettings { disturbed: 0, seed: 0 });
        verifier.nominal(task, &Situation::stated(&task.scene), tools, plan)
    }

    fn json(&self) -> PyResult<serde_json::Value> {
        serde_json::to_value(&self.file).map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }
}
