//! Batch rollouts of candidate pushes into arrays.

use std::sync::Arc;

use numpy::ndarray::Axis;
use numpy::{PyArray1, PyArray2, PyArray3, PyArray4};
use pushplan::progress::Progress;
use pushplan::{
    EffectModel, Job, Outcome, Push, PushForm, Record, Situation, Task, ToolMotion, Trajectory,
    Vector, Warning,
};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::progress::Watch;
use crate::push::MOST;
use crate::task::PyTask;
use crate::tool::{PyToolLibrary, tool};
use crate::{arguments, arrays, wanted, work};

/// Number of candidates between two checks for cancellation: tens of milliseconds with the analytic
/// model.
const AT_ONCE: usize = 256;

/// Columns of a push: x, y, direction, length, speed.
const COLUMNS: usize = 5;

/// Arrays of the rollouts of many candidates.
///
/// Candidates take different numbers of frames. A shorter candidate repeats its last frame, in
/// which all objects rest.
#[pyclass(name = "Rollouts", module = "pushplan", frozen, get_all)]
pub struct Rollouts {
    /// Poses of all objects, `[candidates, frames, objects, 3]`: x and y in metres, heading in
    /// radians. Headings are continuous, without wrapping at pi.
    poses: Py<PyArray4<f64>>,
    /// Poses of the tool frame, `[candidates, frames, 3]`: x and y in metres, heading in radians.
    tool_poses: Py<PyArray3<f64>>,
    /// Time of every frame since the start, seconds: `[candidates, frames]`.
    times: Py<PyArray2<f64>>,
    /// Number of frames of each candidate: `[candidates]`.
    frames: Py<PyArray1<i64>>,
    /// Final distance of the goal's object from the goal, metres: `[candidates]`.
    errors: Py<PyArray1<f64>>,
    /// Final heading error, radians, NaN if the goal states no heading: `[candidates]`.
    heading_errors: Py<PyArray1<f64>>,
    /// Whether the objects rest at the goal and no failure occurred before: `[candidates]`.
    reached: Py<PyArray1<bool>>,
    /// Names of the objects, in the order of `poses`.
    objects: Vec<String>,
    /// Warnings about each candidate's rollout: one list per candidate.
    warnings: Vec<Vec<String>>,
}

#[pymethods]
impl Rollouts {
    fn __len__(&self) -> usize {
        self.warnings.len()
    }

    fn __repr__(&self) -> String {
        format!("<Rollouts of {} candidates>", self.warnings.len())
    }
}

/// Predicts many candidates with one tool, and returns the results as arrays.
///
/// Parameters
/// ----------
/// task : Task
///     Task with the scene and the goal.
/// tool : Tool or str
///     Tool, or the name of a tool in `tools`.
/// pushes : array_like, `[candidates, pushes, 5]` or `[candidates, 5]`
///     Pushes of every candidate, such as `Plan.push_array`: x and y of the end effector at the
///     start (metres), direction (radians from world +x), length (metres) and speed (m/s).
/// grip_yaw : float or array_like, `[candidates]`, default 0
///     Rotation of the end effector against world +x, radians.
/// start : array_like, `[objects, 3]` or `[candidates, objects, 3]`, optional
///     Poses of the objects at the start, at rest: x and y in metres, heading in radians. By
///     default the poses of the task.
/// model : str, default "network"
///     Effect model, such as "network", "prior" (the analytic model), "planar" or "3d".
/// out_of_range : {"warn", "simulate", "refuse"}, default "warn"
///     Action outside the model's validity range: add a warning, simulate in 2-D instead, or return
///     no prediction, with a warning.
/// record : {"frames", "outcome"}, default "frames"
///     Recorded frames: all of them, or only the last one.
/// tools : ToolLibrary, optional
///     Tools for a name in `tool`; by default the tools shipped with the package.
/// threads : int, default 0
///     Number of worker threads; 0 means one per core.
///
/// Returns
/// -------
/// Rollouts
///     Poses, times and errors of all candidates.
///
/// Raises
/// ------
/// UnknownToolError
///     If `tools` contains no tool named `tool`.
/// ModelError
///     If `model` is not the name of an effect model.
/// TypeError or ValueError
///     If an argument has an invalid type, shape or value.
///
/// Examples
/// --------
/// >>> pushes = np.array([[0.47, 0.02, 3.14, 0.20, 0.10], [0.47, 0.02, 3.14, 0.05, 0.10]])
/// >>> rolled = pushplan.rollout(task, "l-hook", pushes, record="outcome")
/// >>> best = pushes[rolled.errors.argmin()]
#[pyfunction]
#[pyo3(signature = (task, tool, pushes, *, grip_yaw = None, start = None, model = "network",
                    out_of_range = "warn", record = "frames", tools = None, threads = 0))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn rollout(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::task)] task: Py<PyTask>,
    tool: &Bound<'_, PyAny>,
    pushes: &Bound<'_, PyAny>,
    grip_yaw: Option<&Bound<'_, PyAny>>,
    start: Option<&Bound<'_, PyAny>>,
    model: &str,
    out_of_range: &str,
    record: &str,
    #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
) -> PyResult<Rollouts> {
    let tool = self::tool(py, tool, tools.as_ref())?;
    let model = arguments::model(py, model, arguments::out_of_range(out_of_range)?)?;
    let record = match record {
        "frames" => Record::Frames,
        "outcome" => Record::Outcome,
        other => {
            let message = format!("`record` must be \"frames\" or \"outcome\", found {other:?}");
            return Err(PyValueError::new_err(message));
        }
    };
    let task = Arc::clone(&task.get().task);
    let pushes = candidates(pushes)?;
    let yaws = yaws(grip_yaw, pushes.len())?;
    let starts = starts(start, &task, pushes.len())?;
    let packed = work::run(py, threads, |cancel| {
        let (rules, scene) = (&task.pushes, &task.scene);
        let placed = rules.form == PushForm::Placed;
        let stated = Situation::stated(scene);
        let job = |k: usize| {
            let motion =
                ToolMotion::pushes(Arc::clone(&tool), rules.lift, yaws[k], &pushes[k], placed);
            let mut job = Job::new(&stated, motion);
            if let Some(starts) = &starts {
                job.start = starts[k % starts.len()].clone();
            }
            job
        };
        let jobs: Vec<Job> = (0..pushes.len()).map(job).collect();
        roll(&model, &task, &jobs, record, cancel)
    })?;
    packed.ok_or_else(|| PyKeyboardInterrupt::new_err(""))?.arrays(py)
}

/// Results of all rollouts, in the order of the arrays.
struct Packed {
    frames: usize,
    poses: Vec<f64>,
    tool_poses: Vec<f64>,
    times: Vec<f64>,
    counts: Vec<i64>,
    outcomes: Vec<Outcome>,
    objects: Vec<String>,
    warnings: Vec<Vec<String>>,
}

/// Rolls out the candidates; returns `None` if cancelled.
fn roll(
    model: &dyn EffectModel,
    task: &Task,
    jobs: &[Job],
    record: Record,
    cancel: &Watch,
) -> Option<Packed> {
    let mut rolled: Vec<Trajectory> = Vec::with_capacity(jobs.len());
    for some in jobs.chunks(AT_ONCE) {
        if cancel.cancelled() {
            return None;
        }
        rolled.extend(model.rollout(&task.scene, some, record));
    }
    let frames = rolled.iter().map(|trajectory| trajectory.frames.len()).max().unwrap_or(0);
    let objects = task.scene.things().count();
    let mut packed = Packed {
        frames,
        poses: Vec::with_capacity(rolled.len() * frames * objects * 3),
        tool_poses: Vec::with_capacity(rolled.len() * frames * 3),
        times: Vec::with_capacity(rolled.len() * frames),
        counts: Vec::with_capacity(rolled.len()),
        outcomes: Vec::with_capacity(rolled.len()),
        objects: task.scene.things().map(|(_, object)| object.name.clone()).collect(),
        warnings: Vec::with_capacity(rolled.len()),
    };
    for trajectory in &rolled {
        packed.add(task, trajectory);
    }
    Some(packed)
}

impl Packed {
    fn add(&mut self, task: &Task, trajectory: &Trajectory) {
        let count = trajectory.frames.len();
        let last = trajectory.frames.last();
        let repeated = std::iter::repeat_n(last, self.frames - count).flatten();
        for frame in trajectory.frames.iter().chain(repeated) {
            let things = frame.state.poses.iter().take(self.objects.len());
            self.poses.extend(things.flat_map(arrays::numbers));
            self.tool_poses.extend(arrays::numbers(&frame.tool));
            self.times.push(frame.time);
        }
        self.counts.push(count as i64);
        self.outcomes.push(Outcome::judge(&task.scene, task, trajectory));
        self.warnings.push(trajectory.warnings.iter().map(Warning::to_string).collect());
    }

    fn arrays(self, py: Python<'_>) -> PyResult<Rollouts> {
        let (candidates, frames, objects) = (self.outcomes.len(), self.frames, self.objects.len());
        let of = |value: &dyn Fn(&Outcome) -> f64| -> Vec<f64> {
            self.outcomes.iter().map(value).collect()
        };
        let errors = of(&|outcome| outcome.error());
        let headings = of(&|outcome| outcome.heading_error().unwrap_or(f64::NAN));
        let reached: Vec<bool> = self.outcomes.iter().map(|outcome| outcome.reached).collect();
        Ok(Rollouts {
            poses: arrays::array(py, self.poses, [candidates, frames, objects, 3])?.unbind(),
            tool_poses: arrays::array(py, self.tool_poses, [candidates, frames, 3])?.unbind(),
            times: arrays::array(py, self.times, [candidates, frames])?.unbind(),
            frames: PyArray1::from_vec(py, self.counts).unbind(),
            errors: PyArray1::from_vec(py, errors).unbind(),
            heading_errors: PyArray1::from_vec(py, headings).unbind(),
            reached: PyArray1::from_vec(py, reached).unbind(),
            objects: self.objects,
            warnings: self.warnings,
        })
    }
}

/// Returns the pushes of every candidate.
fn candidates(pushes: &Bound<'_, PyAny>) -> PyResult<Vec<Vec<Push>>> {
    let shape = "[candidates, pushes, 5] or [candidates, 5] (x, y, direction, length, speed)";
    let pushes = arrays::numbers_of("pushes", pushes, shape)?;
    let all = pushes.as_array();
    let all = match all.ndim() {
        2 => all.insert_axis(Axis(1)),
        _ => all,
    };
    if all.ndim() != 3 || all.len_of(Axis(2)) != COLUMNS || all.len_of(Axis(1)) == 0 {
        let message =
            format!("`pushes` must have the shape {shape}, found {:?}", pushes.as_array().shape());
        return Err(PyValueError::new_err(message));
    }
    for direction in all.index_axis(Axis(2), 2) {
        arguments::angle("direction", *direction)?;
    }
    for (column, name) in [(3, "lengths"), (4, "speeds")] {
        let sound = |value: &f64| *value > 0.0 && *value <= MOST;
        if let Some(found) = all.index_axis(Axis(2), column).iter().find(|&value| !sound(value)) {
            let message =
                format!("{name} of `pushes` must be above 0 and at most {MOST}, found {found}");
            return Err(PyValueError::new_err(message));
        }
    }
    let push = |row: numpy::ndarray::ArrayViewD<'_, f64>| Push {
        start: Vector::new(row[[0]], row[[1]]),
        direction: row[[2]],
        length: row[[3]],
        speed: row[[4]],
    };
    Ok(all.axis_iter(Axis(0)).map(|one| one.axis_iter(Axis(0)).map(push).collect()).collect())
}

/// Returns the grip yaw of every candidate.
fn yaws(given: Option<&Bound<'_, PyAny>>, candidates: usize) -> PyResult<Vec<f64>> {
    let Some(given) = given else { return Ok(vec![0.0; candidates]) };
    let given = arrays::numbers_of("grip_yaw", given, "[] or [candidates]")?;
    let given = given.as_array();
    for yaw in &given {
        arguments::angle("grip_yaw", *yaw)?;
    }
    match given.shape() {
        [] => Ok(vec![given.first().copied().unwrap_or_default(); candidates]),
        [count] if *count == candidates => Ok(given.iter().copied().collect()),
        other => Err(PyValueError::new_err(format!(
            "`grip_yaw` must be one number or have the shape [{candidates}], found {other:?}"
        ))),
    }
}

/// Returns the start states: `None` if not given, one for all candidates, or one per candidate.
fn starts(
    given: Option<&Bound<'_, PyAny>>,
    task: &Task,
    candidates: usize,
) -> PyResult<Option<Vec<pushplan::State>>> {
    let Some(given) = given else { return Ok(None) };
    let objects = task.scene.things().count();
    let given = arrays::numbers_of("start", given, &format!("[{objects}, 3]"))?;
    let given = given.as_array();
    let state = |given: numpy::ndarray::ArrayViewD<'_, f64>| {
        pushplan::State::at_rest(task.scene.with_parts(arrays::state(given).poses))
    };
    match *given.shape() {
        [count, 3] if count == objects => Ok(Some(vec![state(given)])),
        [all, count, 3] if count == objects && all == candidates => {
            Ok(Some(given.axis_iter(Axis(0)).map(state).collect()))
        }
        ref other => Err(PyValueError::new_err(format!(
            "`start` must have the shape [{objects}, 3] or [{candidates}, {objects}, 3], found \
             {other:?}"
        ))),
    }
}
