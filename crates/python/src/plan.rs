//! Plans with their task, tools, predictions and verdicts.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray2;
use pushplan::files::PlanFile;
use pushplan::models::Engine;
use pushplan::planning::ManualPush;
use pushplan::{Job, Push, PushForm, Trajectory, Verdict};
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
use crate::{arguments, arrays, errors, json, page, wanted, work};

/// Plan of pushes or lever-ups for a task, with its prediction and verdict.
///
/// A plan contains its task and its tools, so that prediction, verification and export need no
/// other file. Instances come from `solve`, `Plan.load`, `Plan.parse` and `Plan.of`.
#[pyclass(name = "Plan", module = "pushplan", frozen)]
pub struct PyPlan {
    pub file: PlanFile,
    /// Source of the task.
    pub source: TaskSource,
    /// Predicted motion.
    pub trajectory: Option<Trajectory>,
    /// Violated rules of the task.
    pub violations: Vec<String>,
}

#[pymethods]
impl PyPlan {
    #[new]
    #[pyo3(signature = (*_arguments, **_named))]
    fn new(_arguments: &Bound<'_, PyAny>, _named: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let remedy = "take the best plan of `pushplan.solve(task)`, read a file with \
                      `Plan.load(path)`, or build one with `Plan.of(task, tool, pushes)`";
        Err(wanted::no_constructor("Plan", remedy))
    }

    /// Reads a plan file (JSON).
    ///
    /// Parameters
    /// ----------
    /// path : str or path-like
    ///     Plan file, written by `Plan.save` or by the command `pushplan solve`.
    ///
    /// Returns
    /// -------
    /// Plan
    ///     Plan of the file, with its verdict.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file is unreadable or invalid; it lists all faults.
    ///
    /// Examples
    /// --------
    /// >>> plan.save("best.plan.json")
    /// >>> verdict = pushplan.verify(pushplan.Plan.load("best.plan.json"))
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let file = PlanFile::load(path).map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self::read(file))
    }

    /// Reads the text of a plan file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Content of the file (JSON).
    /// name : str, default "plan"
    ///     File name in error messages.
    ///
    /// Returns
    /// -------
    /// Plan
    ///     Plan of the text, with its verdict.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the text is invalid; it lists all faults.
    #[staticmethod]
    #[pyo3(signature = (text, name = "plan"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        let file =
            PlanFile::parse(text, name).map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self::read(file))
    }

    /// Builds a plan from given pushes, without a search.
    ///
    /// Parameters
    /// ----------
    /// task : Task
    ///     Task of the plan.
    /// tool : Tool or str
    ///     Tool, or the name of a tool in `tools`.
    /// pushes : sequence of Push
    ///     Pushes, in order. A push that violates a rule of the task is allowed; see `violations`.
    /// grip_yaw : float, optional
    ///     Rotation of the end effector against world +x, radians, -4 pi to 4 pi; by default the
    ///     first grip yaw of the task with which the pushes are feasible.
    /// tools : ToolLibrary, optional
    ///     Tools for a name in `tool`; by default the tools shipped with the package.
    ///
    /// Returns
    /// -------
    /// Plan
    ///     Plan without prediction and verdict.
    ///
    /// Raises
    /// ------
    /// ActionError
    ///     If a push is infeasible, for example because the object is unknown; `UnknownToolError`
    ///     for an unknown name in `tool`.
    /// TypeError or ValueError
    ///     If another argument has an invalid type or value.
    ///
    /// Examples
    /// --------
    /// >>> push = pushplan.Push.before("can", math.pi, length=0.15)
    /// >>> plan = pushplan.Plan.of(task, "l-hook", [push])
    #[staticmethod]
    #[pyo3(signature = (task, tool, pushes, *, grip_yaw = None, tools = None))]
    fn of(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted::task)] task: Py<PyTask>,
        tool: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = wanted::pushes)] pushes: Vec<Py<PyPush>>,
        #[pyo3(from_py_with = arguments::grip_yaw)] grip_yaw: Option<f64>,
        #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    ) -> PyResult<Self> {
        let (task, tool) = (task.get(), self::tool(py, tool, tools.as_ref())?);
        let yaws = grip_yaw.map_or_else(|| task.task.pushes.grip_yaws.clone(), |yaw| vec![yaw]);
        let pushes: Vec<ManualPush> = pushes.iter().map(|push| push.get().0.clone()).collect();
        Self::pushing(py, task, tool, &yaws, &pushes)
    }

    /// Task of the plan.
    #[getter]
    fn task(&self) -> PyTask {
        PyTask { task: Arc::new(self.file.task.clone()), source: Some(self.source.clone()) }
    }

    /// First tool of the plan. Raises `ValueError` for a plan without steps.
    #[getter]
    fn tool(&self) -> PyResult<PyTool> {
        let first = self.file.tools.first().map(|tool| PyTool(Arc::clone(tool)));
        first.ok_or_else(|| {
            PyValueError::new_err("the plan has no steps and therefore no tool; see `steps`")
        })
    }

    /// Tools in the order of their use.
    #[getter]
    fn tools(&self) -> Vec<PyTool> {
        self.file.tools.iter().map(|tool| PyTool(Arc::clone(tool))).collect()
    }

    /// Steps in order, with the keys of a plan file: `{"push": ...}` or `{"lever_up": ...}`.
    #[getter]
    fn steps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let steps = serde_json::to_value(&self.file.plan.steps);
        json::dict(py, &steps.map_err(|error| PyRuntimeError::new_err(error.to_string()))?)
    }

    /// Whether the plan contains a lever-up.
    #[getter]
    fn levers(&self) -> bool {
        self.file.plan.levers()
    }

    /// Pushes in order.
    #[getter]
    fn pushes(&self) -> Vec<PyPush> {
        self.file.plan.pushes().iter().map(PyPush::from).collect()
    }

    /// Pushes for `rollout`, `[pushes, 5]`: x and y of the end effector at the start (metres),
    /// direction (radians from world +x), length (metres) and speed (m/s).
    #[getter]
    fn push_array<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let pushes = self.file.plan.pushes();
        let row =
            |push: &Push| [push.start.x, push.start.y, push.direction, push.length, push.speed];
        arrays::array(py, pushes.iter().flat_map(row).collect(), [pushes.len(), 5])
    }

    /// Rotation of the end effector against world +x, radians.
    #[getter]
    fn grip_yaw(&self) -> f64 {
        self.file.plan.grip_yaw()
    }

    /// Form of the pushes. `"placed"`: the robot lifts the tool after each push and sets it down
    /// for the next; `"chained"`: each push starts where the last one ended.
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

    /// Name of the effect model of the prediction; `None` without a prediction.
    #[getter]
    fn model(&self) -> Option<String> {
        self.file.model.as_ref().map(ToString::to_string)
    }

    /// Table fit that the model used; `None` without one.
    #[getter]
    fn fit(&self) -> Option<PyTableFit> {
        self.file.fit.clone().map(PyTableFit)
    }

    /// Predicted distance of the goal's object from the goal, metres; `None` without one.
    #[getter]
    fn error(&self) -> Option<f64> {
        self.file.predicted.as_ref().map(|outcome| outcome.error())
    }

    /// Predicted motion, frame by frame; `None` unless the plan comes from `solve`.
    #[getter]
    fn trajectory(&self) -> Option<PyTrajectory> {
        let trajectory = self.trajectory.clone()?;
        Some(PyTrajectory::new(&Arc::new(self.file.task.clone()), trajectory))
    }

    /// Returns the input graph of the network for one frame of `trajectory`.
    ///
    /// Parameters
    /// ----------
    /// frame : int
    ///     Index of the frame; the graph describes the step from `frame` to `frame + 1`.
    ///
    /// Returns
    /// -------
    /// dict or None
    ///     Dictionary with `nodes` and `relations`. Nodes are objects, obstacles and parts of the
    ///     tool, each with name, kind, pose, size and motion. Relations are contacts and joints
    ///     between nodes, which they name by index. `None` past the last frame, without a
    ///     prediction, and for plans with lever-ups or several tools.
    fn graph<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = arguments::frame)] frame: usize,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
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

    /// Verdict of the replays; `None` for a plan without verification.
    #[getter]
    fn verdict(&self) -> Option<PyVerdict> {
        let verdict = self.file.verdict.clone()?;
        Some(PyVerdict { file: self.file.clone(), verdict })
    }

    /// Rules of the task that the pushes violate. Plans from `solve` violate none.
    #[getter]
    fn violations(&self) -> Vec<String> {
        self.violations.clone()
    }

    /// Writes the plan file (JSON) for `Plan.load` and the command `pushplan verify`.
    ///
    /// The file is replaced as a whole, so that no partial file remains after an error.
    ///
    /// Parameters
    /// ----------
    /// path : str or path-like
    ///     File to write, in an existing folder.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file cannot be written.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.file.write(path).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Returns the plan with the keys of a plan file.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::dict(py, &self.json()?)
    }

    /// Returns a MuJoCo scene (MJCF text) with the objects, the tool, the pushes and the goal.
    pub fn to_mjcf(&self) -> PyResult<String> {
        mjcf(&self.file).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// Returns the interactive report of the plan: one HTML file that plays the replays offline.
    ///
    /// Replays that the plan lacks are computed first.
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
