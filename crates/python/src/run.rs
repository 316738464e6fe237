//! Closed loop, in a simulated world or in a world implemented in Python.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray2;
use pushplan::Noise;
use pushplan_act::act::{ActError, End};
use pushplan_act::{RunSettings, Runner, Trace};
use pushplan_report::{PageView, Recipe, run_document, run_page};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::belief::shipped_regulator;
use crate::progress::Observer;
use crate::push::PyPush;
use crate::solve::{Asked, stated};
use crate::table_fit::PyTableFit;
use crate::task::PyTask;
use crate::tool::{PyToolLibrary, given};
use crate::world::Place;
use crate::{arguments, arrays, errors, json, page, wanted, work};

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

    /// Writes the trace of the run (`*.run.json`).
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
/// progress : bool or callable, optional
///     Receiver of the stage and the number of executed motions, see `solve`.
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
///
/// Examples
/// --------
/// >>> task = pushplan.Task.example("hidden-hinge")
/// >>> ran = pushplan.run(task, 1)
/// >>> print(ran.end, len(ran.pushes))
#[pyfunction]
#[pyo3(signature = (task, world, tools = None, *, effort = "draft", model = None,
                    out_of_range = "warn", seed = 0, max_pushes = 12, samples = 16,
                    min_success = 0.8, max_probes = 3, noise = None, fit = None,
                    regulator = true, threads = 0, progress = None))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn run(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::task)] task: Py<PyTask>,
    world: Bound<'_, PyAny>,
    #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    effort: &str,
    model: Option<&str>,
    out_of_range: &str,
    #[pyo3(from_py_with = arguments::seed)] seed: u64,
    #[pyo3(from_py_with = arguments::max_pushes)] max_pushes: usize,
    #[pyo3(from_py_with = arguments::samples)] samples: usize,
    #[pyo3(from_py_with = arguments::min_success)] min_success: f64,
    #[pyo3(from_py_with = arguments::max_probes)] max_probes: usize,
    noise: Option<(f64, f64)>,
    #[pyo3(from_py_with = wanted::fit)] fit: Option<Py<PyTableFit>>,
    regulator: bool,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyRun> {
    let (task, fit) = (task.get(), fit.as_ref().map(|fit| &fit.get().0));
    let observer = Observer::of(py, progress)?;
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
    let defaults = RunSettings::default();
    let noise = match noise {
        Some((position, heading)) if position > 0.0 && heading > 0.0 => Noise { position, heading },
        Some(found) => {
            let message =
                format!("`noise` must be two numbers above 0, metres and radians, found {found:?}");
            return Err(PyValueError::new_err(message));
        }
        None => defaults.noise,
    };
    let settings =
        RunSettings { max_pushes, samples, min_success, max_probes, noise, seed, ..defaults };
    let mut place = Place::of(py, &task.task, &library, world)?;
    let planned_by =
        format!("{}, effort {effort}, out-of-range {out_of_range}", model.unwrap_or("default"));
    let stated = stated(Arc::clone(&task.task), fit);
    let mut trace = Trace::new(stated.as_ref().clone(), settings, planned_by, None);
    let ran = work::follow(py, threads, &observer, |watch| {
        runner.run_with(&mut trace, &mut place, &mut |_| Ok(()), watch)
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
