//! Tasks.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray2;
use pushplan::asset::{load_example, load_task};
use pushplan::task::ToolChoice;
use pushplan::{Pose, State, Task};
use pushplan_report::TaskSource;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::arrays::Numbers;
use crate::json::{dict, unpickled};
use crate::mapping::Text;
use crate::moved::moved;
use crate::tool::PyToolLibrary;
use crate::{arrays, errors};

/// A scene, a robot, what pushes are allowed, and a goal.
///
/// Lengths are metres, angles radians, masses kilograms; in files and mappings, keys that end in
/// `_deg` are degrees. x points forward from the robot's base, which is the origin.
#[pyclass(name = "Task", module = "pushplan", frozen)]
pub struct PyTask {
    pub task: Arc<Task>,
    /// Source of the task, if it was read.
    pub source: Option<TaskSource>,
}

#[pymethods]
impl PyTask {
    /// Reads a task file (YAML). Raises `FileError` with all its faults; names of tools that are
    /// not among `tools` are faults, too, where those are given.
    #[staticmethod]
    #[pyo3(signature = (path, tools = None))]
    fn load(py: Python<'_>, path: PathBuf, tools: Option<&PyToolLibrary>) -> PyResult<Self> {
        let task = match tools {
            Some(tools) => load_task(&path, &tools.0),
            None => Task::load(&path),
        };
        let task = task.map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self { task: Arc::new(task), source: Some(TaskSource::of(path)) })
    }

    /// A shipped task; `Task.examples` lists them. Raises `FileError` if there is none of this name,
    /// and if it names tools that are not among `tools`, where those are given.
    #[staticmethod]
    #[pyo3(signature = (name, tools = None))]
    fn example(py: Python<'_>, name: &str, tools: Option<&PyToolLibrary>) -> PyResult<Self> {
        let task = match tools {
            Some(tools) => load_example(name, &tools.0),
            None => Task::example(name),
        };
        let task = task.map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self { task: Arc::new(task), source: Some(TaskSource::Example(name.to_owned())) })
    }

    /// Names of the shipped tasks.
    #[staticmethod]
    fn examples() -> Vec<&'static str> {
        Task::examples().collect()
    }

    /// Reads the text of a task file; `name` names it in faults, and a task without a name.
    #[staticmethod]
    #[pyo3(signature = (text, name = "task"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        let task = Task::parse(text, name).map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self { task: Arc::new(task), source: None })
    }

    /// Builds a task from a mapping with the keys of a task file: lengths in metres, masses in
    /// kilograms, angles in degrees. See `pushplan.files.TaskFile`.
    #[staticmethod]
    fn from_dict(py: Python<'_>, mapping: &Bound<'_, PyAny>) -> PyResult<Self> {
        let task = Text::of(mapping)?.read(py, "task", Task::parse)?;
        Ok(Self { task: Arc::new(task), source: None })
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.task.name
    }

    /// One line for people.
    #[getter]
    fn description(&self) -> &str {
        &self.task.description
    }

    /// Names of the objects; arrays of poses are in this order.
    #[getter]
    fn objects(&self) -> Vec<&str> {
        self.task.scene.things().map(|(_, object)| object.name.as_str()).collect()
    }

    /// Poses of the objects at the start, `[objects, 3]`: x and y in metres, heading in radians.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let poses: Vec<Pose> = self.task.scene.things().map(|(_, object)| object.pose).collect();
        arrays::poses(py, &poses)
    }

    /// Names of the tools to choose from; `None` for all of the library.
    #[getter]
    fn tools(&self) -> Option<Vec<String>> {
        match &self.task.tools {
            ToolChoice::All => None,
            ToolChoice::Named(names) => Some(names.clone()),
        }
    }

    /// Name of the object to bring to the goal.
    #[getter]
    fn goal_object(&self) -> &str {
        &self.task.scene.objects[self.task.goals[0].object].name
    }

    /// Names of the objects with goals, in the order of the goals.
    #[getter]
    fn goal_objects(&self) -> Vec<&str> {
        let names = self.task.goals.iter().map(|goal| &self.task.scene.objects[goal.object].name);
        names.map(String::as_str).collect()
    }

    /// Wanted position of the first goal at the start, metres.
    #[getter]
    fn goal_position(&self) -> (f64, f64) {
        let goal = self.task.goals[0].place(&self.task.scene.start());
        (goal.x, goal.y)
    }

    /// Largest distance from the goal that still counts as success, metres.
    #[getter]
    fn tolerance(&self) -> f64 {
        self.task.goals[0].tolerance()
    }

    /// Wanted heading, radians, where one is asked for.
    #[getter]
    fn goal_heading(&self) -> Option<f64> {
        self.task.goals[0].heading().map(|facing| facing.heading)
    }

    /// Largest heading error that still counts as success, radians, where one is asked for.
    #[getter]
    fn heading_tolerance(&self) -> Option<f64> {
        self.task.goals[0].heading().map(|facing| facing.tolerance)
    }

    /// Turns of the end effector against world +x that a plan may choose from, radians.
    #[getter]
    fn grip_yaws(&self) -> Vec<f64> {
        self.task.pushes.grip_yaws.clone()
    }

    /// Travel of a push unless it says another, metres.
    #[getter]
    fn push_length(&self) -> f64 {
        self.task.pushes.length
    }

    /// Speed of a push unless it says another, m/s.
    #[getter]
    fn push_speed(&self) -> f64 {
        self.task.pushes.speed
    }

    /// Largest number of pushes in a plan.
    #[getter]
    fn max_pushes(&self) -> usize {
        self.task.pushes.max_count
    }

    /// Smallest and largest distance of the end effector from the robot's base, metres.
    #[getter]
    fn reach(&self) -> (f64, f64) {
        (self.task.robot.reach_min, self.task.robot.reach_max)
    }

    /// Share of the disturbed replays that must reach the goal for a plan to count, 0 to 1.
    #[getter]
    fn robustness(&self) -> f64 {
        self.task.robustness
    }

    /// The task with its objects at these poses, `[objects, 3]` (x and y in metres, heading in
    /// radians): to plan on from where they are by now. Joints move along.
    fn at(&self, poses: Numbers<'_>) -> PyResult<Self> {
        let poses = self.poses(&poses)?;
        Ok(Self { task: Arc::new(moved(&self.task, &poses)), source: self.source.clone() })
    }

    /// Error of the goals with the objects at rest at these poses, `[objects, 3]`, in units of the
    /// tolerances, the largest of all demands of all goals: at most 1 is success.
    fn score(&self, poses: Numbers<'_>) -> PyResult<f64> {
        Ok(self.task.score(&State::at_rest(self.poses(&poses)?)))
    }

    /// Whether each goal is reached with the objects at rest at these poses, `[objects, 3]`.
    fn reached(&self, poses: Numbers<'_>) -> PyResult<Vec<bool>> {
        let state = State::at_rest(self.poses(&poses)?);
        Ok(self.task.goals.iter().map(|goal| goal.reached(&state)).collect())
    }

    /// Names of the objects that errors of the goals are of with the objects at these poses,
    /// `[objects, 3]`, in the order of the goals: of a goal that leaves a choice the one that misses it.
    fn goal_subjects(&self, poses: Numbers<'_>) -> PyResult<Vec<&str>> {
        let state = State::at_rest(self.poses(&poses)?);
        let subjects = self.task.goals.iter().map(|goal| goal.subject(&state));
        Ok(subjects.map(|k| self.task.scene.objects[k].name.as_str()).collect())
    }

    /// Offsets from the goals with the objects at these poses, `[objects, 3]`, as `[goals, 3]`: x and y
    /// from the nearest wanted place to the object, metres, and its turn from the wanted heading, radians;
    /// 0 where none is asked for.
    fn goal_offsets<'py>(
        &self,
        py: Python<'py>,
        poses: Numbers<'_>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let state = State::at_rest(self.poses(&poses)?);
        let offsets = self.task.goals.iter().flat_map(|goal| {
            let (off, turn) = (goal.off(&state), goal.turned(&state).unwrap_or(0.0));
            [off.x, off.y, turn]
        });
        arrays::array(py, offsets.collect(), [self.task.goals.len(), 3])
    }

    /// The keys of its file, from which `Task.from_dict` makes it again.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        dict(py, &self.task.to_json())
    }

    /// The text of its file.
    fn to_yaml(&self, py: Python<'_>) -> PyResult<String> {
        self.task.to_yaml().map_err(|faults| errors::files(py, &faults, None))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        unpickled(py, "Task", &self.task.to_json())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.task == other.task
    }

    fn __repr__(&self) -> String {
        format!("<Task {}>", self.task.name)
    }
}

impl PyTask {
    /// Returns the source of the task for a command line.
    pub fn source(&self) -> TaskSource {
        let unread = || TaskSource::File(format!("{}.yaml", self.task.name));
        self.source.clone().unwrap_or_else(unread)
    }

    /// Converts an array to the poses of the task's objects.
    fn poses(&self, poses: &Numbers<'_>) -> PyResult<Vec<Pose>> {
        let (poses, objects) = (poses.as_array(), self.task.scene.things().count());
        arrays::finite("poses", &poses)?;
        if *poses.shape() != [objects, 3] {
            let message = format!("`poses` is [{objects}, 3], found {:?}", poses.shape());
            return Err(PyValueError::new_err(message));
        }
        Ok(self.task.scene.with_parts(arrays::state(poses).poses))
    }

    /// Returns the task, with its robustness replaced if one is given.
    pub fn robust(&self, robustness: Option<f64>) -> PyResult<Arc<Task>> {
        match robustness {
            None => Ok(Arc::clone(&self.task)),
            Some(share) if (0.0..=1.0).contains(&share) => {
                Ok(Arc::new(Task::clone(&self.task).robust(share)))
            }
            Some(_) => Err(PyValueError::new_err("`robustness` is a share from 0 to 1")),
        }
    }
}
