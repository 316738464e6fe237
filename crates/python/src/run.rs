//! Closed loop, in a simulated world or in a world implemented in Python.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray2;
use pushplan::{Noise, ObservedPose, Tool, ToolMotion, Vector};
use pushplan_act::act::{ActError, End, Look, SimulatedWorld, World, WorldError};
use pushplan_act::{RunSettings, Runner, Trace, hidden};
use pushplan_report::{PageView, Recipe, run_document, run_page};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::arrays::{self, Numbers};
use crate::belief::shipped_regulator;
use crate::push::PyPush;
use crate::solve::{Asked, stated};
use crate::table_fit::PyTableFit;
use crate::task::PyTask;
use crate::tool::{PyTool, PyToolLibrary, given};
use crate::{arguments, errors, json, page, work};

/// Motion that a world executes. The robot sets the tool down at the start of the first stroke,
/// moves it along all strokes, waits until the objects rest, and lifts it.
#[pyclass(name = "Motion", module = "pushplan", frozen)]
pub struct PyMotion(ToolMotion);

#[pymethods]
impl PyMotion {
    /// Tool of the motion.
    #[getter]
    fn tool(&self) -> PyTool {
        PyTool(Arc::clone(&self.0.tool))
    }

    /// Height of the tool's underside above the table, metres.
    #[getter]
    fn lift(&self) -> f64 {
        self.0.lift
    }

    /// Poses of the end effector at start and end of every stroke, `[strokes, 6]`: x, y (metres),
    /// heading (radians), x, y, heading.
    #[getter]
    fn end_effector<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let grip = self.0.tool.grip;
        let ends = self.0.strokes.iter().flat_map(|stroke| [stroke.from * grip, stroke.to * grip]);
        let numbers = ends.flat_map(|pose| arrays::numbers(&pose)).collect();
        arrays::array(py, numbers, [self.0.strokes.len(), 6])
    }

    /// Poses of the tool frame, in the format of `end_effector`.
    #[getter]
    fn tool_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let ends = self.0.strokes.iter().flat_map(|stroke| [stroke.from, stroke.to]);
        let numbers = ends.flat_map(|pose| arrays::numbers(&pose)).collect();
        arrays::array(py, numbers, [self.0.strokes.len(), 6])
    }

    /// Duration of each stroke, seconds.
    #[getter]
    fn durations(&self) -> Vec<f64> {
        self.0.strokes.iter().map(|stroke| stroke.duration).collect()
    }

    fn __repr__(&self) -> String {
        format!("<Motion of {} strokes with {}>", self.0.strokes.len(), self.0.tool.name)
    }
}

/// Record of a closed-loop run: observations, beliefs, plans and pushes.
#[pyclass(name = "Run", module = "pushplan", frozen)]
pub struct PyRun(Trace);

#[pymethods]
impl PyRun {
    /// Reason for the end: `"reached"`, `"budget_exhausted"` (all allowed pushes are made),
    /// `"no_improving_push"` (no push brings the object nearer to the goal) or `"rule_broken"` (an
    /// object breaks `keep` or `keep_out`).
    #[getter]
    fn end(&self) -> &'static str {
        match self.0.end {
            Some(End::Reached) => "reached",
            Some(End::BudgetExhausted) => "budget_exhausted",
            Some(End::RuleBroken) => "rule_broken",
            Some(End::NoImprovingPush) | None => "no_improving_push",
        }
    }

    /// Whether the goal is reached according to the observations.
    #[getter]
    fn reached(&self) -> bool {
        self.0.end == Some(End::Reached)
    }

    /// Executed pushes in order.
    #[getter]
    fn pushes(&self) -> Vec<PyPush> {
        let steps = self.0.steps.iter();
        let made = steps.flat_map(|step| step.plan.pushes().into_iter().take(step.pushes));
        made.map(|push| PyPush::from(&push)).collect()
    }

    /// Final poses in the belief, `[objects, 3]`: x and y in metres, heading in radians.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        match self.0.steps.last() {
            Some(step) => arrays::poses(py, &step.state.poses),
            None => arrays::poses(py, &self.0.task.scene.start().poses),
        }
    }

    /// Table fit after the run; `None` without one, for example with `unknown` values.
    #[getter]
    fn fit(&self) -> Option<PyTableFit> {
        self.0.learnt.clone().map(PyTableFit)
    }

    /// Notes about inconsistent observations and motions that ended early, one sentence each.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.all_notes().map(|note| note.words(&self.0.task.scene)).collect()
    }

    /// Writes the trace of the run (`*.run.json`), or raises `FileError`.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.0.write(&path).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Restores a run from the text that pickle stores.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        serde_json::from_str(text).map(Self).map_err(json::damaged)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let trace = serde_json::to_value(&self.0);
        let trace = trace.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        json::unpickled(py, "Run", &trace)
    }

    fn __eq__(&self, other: &Self) -> bool {
        let trace = |run: &Self| serde_json::to_value(&run.0).ok();
        trace(self) == trace(other)
    }

    /// Returns the run with the keys of its trace.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let trace = serde_json::to_string(&self.0);
        json::text(py, &trace.map_err(|error| PyRuntimeError::new_err(error.to_string()))?)
    }

    /// Returns the interactive report: one HTML file that plays the run offline.
    fn page(&self) -> String {
        // The page states no command, because the run was made in Python.
        run_page(&self.0, &[], Recipe::default(), PageView::Above)
    }

    fn _repr_html_(&self) -> String {
        page::frame(&self.page())
    }

    fn __str__(&self) -> String {
        run_document(&self.0).to_text()
    }

    fn __repr__(&self) -> String {
        format!("<Run of {}: {} after {} pushes>", self.0.task.name, self.end(), self.0.pushes())
    }
}

/// Carries out a task in closed loop: plans, pushes, observes, updates its belief and plans again.
///
/// Parameters
/// ----------
/// task : Task
///     Task; its `unknown` values are estimated during the run.
/// world : int or object
///     Seed of a simulated world with hidden ground truth, or an object with these methods:
///     `look()` returns the observed poses at rest, `[objects, 3]`: x and y in metres, heading in
///     radians, NaN for a number without observation. `act(motion)` executes a `Motion` and returns
///     pairs of a time since its start, seconds, and such an array; the last one is at rest. The
///     optional `change_tool(tool)` is called before a motion with another tool.
/// tools, effort, model, out_of_range, seed, threads
///     Options of the planner, see `solve`.
/// max_pushes : int, default 12
///     Maximum number of pushes, at most 1000.
/// samples : int, default 16
///     Number of belief samples in which plans are evaluated, 1 to 1000.
/// min_success : float, default 0.8
///     Minimum share of the samples in which a plan must reach the goal, 0 to 1. Such a plan needs
///     no exploratory pushes.
/// max_probes : int, default 3
///     Maximum number of exploratory pushes.
/// noise : tuple of float, optional
///     Standard deviations of the observations, metres and radians.
/// fit : TableFit, optional
///     Table fit of this table; the pushes of the run continue the fit.
/// regulator : bool, default True
///     Whether the belief regulator corrects the probabilities of joints.
///
/// Returns
/// -------
/// Run
///     Outcome, pushes and final belief.
///
/// Raises
/// ------
/// TypeError or ValueError
///     If an argument is invalid. The function also raises the errors of `solve` and any
///     exception of `world`, which ends the run.
#[pyfunction]
#[pyo3(signature = (task, world, tools = None, *, effort = "draft", model = None,
                    out_of_range = "warn", seed = 0, max_pushes = 12, samples = 16,
                    min_success = 0.8, max_probes = 3, noise = None, fit = None,
                    regulator = true, threads = 0))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn run(
    py: Python<'_>,
    task: &PyTask,
    world: Bound<'_, PyAny>,
    tools: Option<Py<PyToolLibrary>>,
    effort: &str,
    model: Option<&str>,
    out_of_range: &str,
    seed: u64,
    max_pushes: usize,
    samples: usize,
    min_success: f64,
    max_probes: usize,
    noise: Option<(f64, f64)>,
    fit: Option<Py<PyTableFit>>,
    regulator: bool,
    threads: usize,
) -> PyResult<PyRun> {
    let fit = fit.as_ref().map(|fit| &fit.get().0);
    let (replays, time_limit) = (None, None);
    let planner =
        Asked { effort, model, out_of_range, seed, replays, time_limit, fit }.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let mut runner = Runner::new(&planner, &library)
        .learning(fit.cloned())
        .map_err(|error| errors::model(py, &error))?;
    if regulator {
        runner = runner.regulated(shipped_regulator()?);
    }
    if !(0.0..=1.0).contains(&min_success) || !(1..=1000).contains(&samples) || max_pushes > 1000 {
        let message =
            "`min_success` must be 0 to 1, `samples` 1 to 1000 and `max_pushes` at most 1000";
        return Err(PyValueError::new_err(message));
    }
    let defaults = RunSettings::default();
    let noise = match noise {
        Some((position, heading)) if position > 0.0 && heading > 0.0 => Noise { position, heading },
        Some(found) => {
            let message = format!("`noise` must be two numbers above 0, found {found:?}");
            return Err(PyValueError::new_err(message));
        }
        None => defaults.noise,
    };
    let settings =
        RunSettings { max_pushes, samples, min_success, max_probes, noise, seed, ..defaults };
    let mut place = match world.extract::<u64>() {
        Ok(number) => {
            let truth = hidden(&task.task, &library, number);
            let truth = truth.map_err(|faults| errors::files(py, &faults, None))?;
            let world = SimulatedWorld::new(truth).pushed_with(task.task.robot.max_force);
            Place::Drawn(Box::new(world))
        }
        Err(_) if world.hasattr("look")? && world.hasattr("act")? => {
            Place::Theirs { object: world.unbind(), raised: None }
        }
        Err(_) => {
            let message =
                "`world` must be a whole number, or an object with the methods `look` and `act`";
            return Err(PyTypeError::new_err(message));
        }
    };
    let planned_by =
        format!("{}, effort {effort}, out-of-range {out_of_range}", model.unwrap_or("default"));
    let stated = stated(Arc::clone(&task.task), fit);
    let mut trace = Trace::new(stated.as_ref().clone(), settings, planned_by, None);
    let threads = arguments::threads(threads)?;
    let ran = work::run(py, threads, |cancel| {
        runner.run_with(&mut trace, &mut place, &mut |_| Ok(()), cancel)
    })?;
    if let Place::Theirs { raised: Some(error), .. } = place {
        return Err(error);
    }
    match ran {
        Ok(()) => Ok(PyRun(trace)),
        Err(ActError::Solve(error)) => Err(errors::solve(py, &error)),
        Err(error @ ActError::Objects { .. }) => Err(PyValueError::new_err(error.to_string())),
        Err(error) => Err(PyRuntimeError::new_err(error.to_string())),
    }
}

/// World in which a run acts.
enum Place {
    /// World simulated by the library.
    Drawn(Box<SimulatedWorld>),
    /// World implemented by a Python object, with the exception it raised, if any.
    Theirs { object: Py<PyAny>, raised: Option<PyErr> },
}

impl Place {
    /// Calls the Python object; an exception is kept for the caller of the run.
    fn ask<T>(
        &mut self,
        ask: impl FnOnce(Python<'_>, &Bound<'_, PyAny>) -> PyResult<T>,
    ) -> Result<T, WorldError> {
        let Place::Theirs { object, raised } = self else {
            return Err(WorldError("this world is simulated and has no Python object".to_owned()));
        };
        Python::attach(|py| {
            ask(py, object.bind(py)).map_err(|error| {
                let words = WorldError(error.to_string());
                *raised = Some(error);
                words
            })
        })
    }
}

impl World for Place {
    fn look(&mut self) -> Result<Look, WorldError> {
        match self {
            Place::Drawn(world) => world.look(),
            Place::Theirs { .. } => self.ask(|_, world| {
                let seen = sights(&world.call_method0("look")?)?;
                Ok(Look { time: 0.0, seen })
            }),
        }
    }

    fn change_tool(&mut self, tool: &Tool) -> Result<(), WorldError> {
        match self {
            Place::Drawn(_) => Ok(()),
            Place::Theirs { .. } => self.ask(|_, world| {
                if world.hasattr("change_tool")? {
                    world.call_method1("change_tool", (PyTool(Arc::new(tool.clone())),))?;
                }
                Ok(())
            }),
        }
    }

    fn act(&mut self, motion: &ToolMotion) -> Result<Vec<Look>, WorldError> {
        match self {
            Place::Drawn(world) => world.act(motion),
            Place::Theirs { .. } => self.ask(|_, world| {
                let looks = world.call_method1("act", (PyMotion(motion.clone()),))?;
                let look = |pair: Bound<'_, PyAny>| {
                    let (time, poses): (f64, Bound<'_, PyAny>) = pair.extract()?;
                    Ok(Look { time, seen: sights(&poses)? })
                };
                looks.try_iter()?.map(|pair| look(pair?)).collect()
            }),
        }
    }

    fn stopped(&self) -> Option<pushplan_act::act::Stop> {
        match self {
            Place::Drawn(world) => world.stopped(),
            Place::Theirs { .. } => None,
        }
    }

    fn save(&self) -> Option<pushplan_act::act::WorldState> {
        match self {
            Place::Drawn(world) => world.save(),
            Place::Theirs { .. } => None,
        }
    }
}

/// Converts an array `[objects, 3]` to observations.
fn sights(array: &Bound<'_, PyAny>) -> PyResult<Vec<Option<ObservedPose>>> {
    let numbers: Numbers<'_> = array.extract()?;
    let numbers = numbers.as_array();
    if numbers.ndim() != 2 || numbers.shape()[1] != 3 {
        let message = format!(
            "observed poses must have the shape [objects, 3], found {:?}; see `pushplan.run`",
            numbers.shape()
        );
        return Err(PyValueError::new_err(message));
    }
    let sight = |k: usize| {
        let [x, y, heading] = [0, 1, 2].map(|column| numbers[[k, column]]);
        let heading = heading.is_finite().then_some(heading);
        let seen = x.is_finite() && y.is_finite();
        seen.then_some(ObservedPose { position: Vector::new(x, y), heading })
    };
    Ok((0..numbers.shape()[0]).map(sight).collect())
}
