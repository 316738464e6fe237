//! Tasks.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray2;
use pushplan::files::{load_example, load_task};
use pushplan::goals::ToolChoice;
use pushplan::{Pose, State, Task};
use pushplan_report::TaskSource;
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::json::{dict, unpickled};
use crate::mapping::Text;
use crate::moved::moved;
use crate::tool::PyToolLibrary;
use crate::wanted::no_constructor;
use crate::{arrays, errors, wanted};

/// Planning task: scene, robot, allowed pushes and goals.
///
/// Lengths are metres, angles radians and masses kilograms. In files and mappings, keys that end in
/// `_deg` are degrees. The robot's base is the origin, and x points forward from it. Instances come
/// from `Task.load`, `Task.example`, `Task.parse`, `Task.from_dict` and `import_task`.
#[pyclass(name = "Task", module = "pushplan", frozen)]
pub struct PyTask {
    pub task: Arc<Task>,
    /// Source of the task, if it was read.
    pub source: Option<TaskSource>,
}

#[pymethods]
impl PyTask {
    #[new]
    #[pyo3(signature = (*_arguments, **_named))]
    fn new(_arguments: &Bound<'_, PyAny>, _named: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Err(no_constructor(
            "Task",
            "read a file with `Task.load(path)`, take a shipped task with `Task.example(name)`, \
             or build one with `Task.from_dict(mapping)`",
        ))
    }

    /// Reads a task file (YAML).
    ///
    /// Parameters
    /// ----------
    /// path : str or path-like
    ///     Task file.
    /// tools : ToolLibrary, optional
    ///     Tools to check the names of the task against; by default names are not checked.
    ///
    /// Returns
    /// -------
    /// Task
    ///     Task of the file.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file is unreadable or invalid, or names a tool that `tools` lacks. It lists all
    ///     faults.
    ///
    /// Examples
    /// --------
    /// >>> task = pushplan.Task.load("my-task.yaml")
    #[staticmethod]
    #[pyo3(signature = (path, tools = None))]
    fn load(
        py: Python<'_>,
        path: PathBuf,
        #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    ) -> PyResult<Self> {
        let task = match tools {
            Some(tools) => load_task(&path, &tools.get().0),
            None => Task::load(&path),
        };
        let task = task.map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self { task: Arc::new(task), source: Some(TaskSource::of(path)) })
    }

    /// Returns a task shipped with the package.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Name of the task, one of `Task.examples()`.
    /// tools : ToolLibrary, optional
    ///     Tools to check the names of the task against; by default names are not checked.
    ///
    /// Returns
    /// -------
    /// Task
    ///     Shipped task.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If no shipped task has this name, or the task names a tool that `tools` lacks.
    ///
    /// Examples
    /// --------
    /// >>> task = pushplan.Task.example("pull-back-behind-wall")
    #[staticmethod]
    #[pyo3(signature = (name, tools = None))]
    fn example(
        py: Python<'_>,
        name: &str,
        #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    ) -> PyResult<Self> {
        let task = match tools {
            Some(tools) => load_example(name, &tools.get().0),
            None => Task::example(name),
        };
        let task = task.map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self { task: Arc::new(task), source: Some(TaskSource::Example(name.to_owned())) })
    }

    /// Returns the names of the shipped tasks.
    #[staticmethod]
    fn examples() -> Vec<&'static str> {
        Task::examples().collect()
    }

    /// Reads the text of a task file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Content of the file (YAML).
    /// name : str, default "task"
    ///     File name in error messages; also the name of a task that states none.
    ///
    /// Returns
    /// -------
    /// Task
    ///     Task of the text.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the text is invalid; it lists all faults.
    #[staticmethod]
    #[pyo3(signature = (text, name = "task"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        let task = Task::parse(text, name).map_err(|faults| errors::files(py, &faults, None))?;
        Ok(Self { task: Arc::new(task), source: None })
    }

    /// Builds a task from a mapping with the keys of a task file.
    ///
    /// Parameters
    /// ----------
    /// mapping : pushplan.files.TaskFile
    ///     Mapping with lengths in metres, masses in kilograms and angles in degrees. NumPy arrays
    ///     count as lists.
    ///
    /// Returns
    /// -------
    /// Task
    ///     Task of the mapping.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If a value is invalid; it lists all faults with their keys.
    /// TypeError
    ///     If the mapping contains other types than a file.
    ///
    /// Examples
    /// --------
    /// >>> stricter = pushplan.Task.from_dict({**task.to_dict(), "robustness": 0.9})
    #[staticmethod]
    fn from_dict(py: Python<'_>, mapping: &Bound<'_, PyAny>) -> PyResult<Self> {
        let task = Text::of(mapping)?.read(py, "task", Task::parse)?;
        Ok(Self { task: Arc::new(task), source: None })
    }

    /// Name of the task.
    #[getter]
    fn name(&self) -> &str {
        &self.task.name
    }

    /// Description for people, one line; may be empty.
    #[getter]
    fn description(&self) -> &str {
        &self.task.description
    }

    /// Names of the objects, in the order of arrays of poses.
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

    /// Names of the tools to choose from; `None` stands for the whole library.
    #[getter]
    fn tools(&self) -> Option<Vec<String>> {
        match &self.task.tools {
            ToolChoice::All => None,
            ToolChoice::Named(names) => Some(names.clone()),
        }
    }

    /// Name of the object of the first goal.
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

    /// Position of the first goal, metres, with all objects at the start.
    #[getter]
    fn goal_position(&self) -> (f64, f64) {
        let goal = self.task.goals[0].place(&self.task.scene.start());
        (goal.x, goal.y)
    }

    /// Maximum distance from the first goal that counts as success, metres.
    #[getter]
    fn tolerance(&self) -> f64 {
        self.task.goals[0].tolerance()
    }

    /// Heading of the first goal, radians; `None` if it states none.
    #[getter]
    fn goal_heading(&self) -> Option<f64> {
        self.task.goals[0].heading().map(|facing| facing.heading)
    }

    /// Maximum heading error that counts as success, radians; `None` without a heading.
    #[getter]
    fn heading_tolerance(&self) -> Option<f64> {
        self.task.goals[0].heading().map(|facing| facing.tolerance)
    }

    /// Allowed rotations of the end effector against world +x, radians.
    #[getter]
    fn grip_yaws(&self) -> Vec<f64> {
        self.task.pushes.grip_yaws.clone()
    }

    /// Default travel of a push, metres.
    #[getter]
    fn push_length(&self) -> f64 {
        self.task.pushes.length
    }

    /// Default speed of a push, m/s.
    #[getter]
    fn push_speed(&self) -> f64 {
        self.task.pushes.speed
    }

    /// Maximum number of pushes in a plan.
    #[getter]
    fn max_pushes(&self) -> usize {
        self.task.pushes.max_count
    }

    /// Minimum and maximum distance of the end effector from the robot's base, metres.
    #[getter]
    fn reach(&self) -> (f64, f64) {
        (self.task.robot.reach_min, self.task.robot.reach_max)
    }

    /// Minimum share of the perturbed replays that must reach the goal, 0 to 1.
    #[getter]
    fn robustness(&self) -> f64 {
        self.task.robustness
    }

    /// Returns the task with other initial poses, for planning from the current state.
    ///
    /// Joints move with their objects.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, `[objects, 3]`
    ///     Poses of the objects: x and y in metres, heading in radians.
    ///
    /// Returns
    /// -------
    /// Task
    ///     Task with these poses.
    ///
    /// Raises
    /// ------
    /// TypeError or ValueError
    ///     If the array has another type or shape, a number is not finite, an object is more than
    ///     2 m beyond the reach, or a heading is beyond 8 pi.
    ///
    /// Examples
    /// --------
    /// >>> seen = task.start + [0.01, 0.0, 0.1]
    /// >>> solution = pushplan.solve(task.at(seen), effort="draft")
    fn at(&self, poses: &Bound<'_, PyAny>) -> PyResult<Self> {
        let poses = self.poses(poses)?;
        Ok(Self { task: Arc::new(moved(&self.task, &poses)), source: self.source.clone() })
    }

    /// Returns the largest error of all goals in units of their tolerances; at most 1 is success.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, `[objects, 3]`
    ///     Poses of the objects at rest: x and y in metres, heading in radians.
    fn score(&self, poses: &Bound<'_, PyAny>) -> PyResult<f64> {
        Ok(self.task.score(&State::at_rest(self.poses(poses)?)))
    }

    /// Returns for each goal whether the objects reach it at these poses, at rest.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, `[objects, 3]`
    ///     Poses of the objects: x and y in metres, heading in radians.
    fn reached(&self, poses: &Bound<'_, PyAny>) -> PyResult<Vec<bool>> {
        let state = State::at_rest(self.poses(poses)?);
        Ok(self.task.goals.iter().map(|goal| goal.reached(&state)).collect())
    }

    /// Returns for each goal the name of the object to which its error refers.
    ///
    /// A goal may allow several objects; the error then refers to the object that misses the goal.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, `[objects, 3]`
    ///     Poses of the objects at rest: x and y in metres, heading in radians.
    fn goal_subjects(&self, poses: &Bound<'_, PyAny>) -> PyResult<Vec<&str>> {
        let state = State::at_rest(self.poses(poses)?);
        let subjects = self.task.goals.iter().map(|goal| goal.subject(&state));
        Ok(subjects.map(|k| self.task.scene.objects[k].name.as_str()).collect())
    }

    /// Returns the offsets of the objects from their goals.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, `[objects, 3]`
    ///     Poses of the objects at rest: x and y in metres, heading in radians.
    ///
    /// Returns
    /// -------
    /// ndarray, `[goals, 3]`
    ///     Offset from the nearest goal position to the object, x and y in metres, and rotation
    ///     from the goal heading, radians. Values without a criterion in the goal are 0.
    fn goal_offsets<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let state = State::at_rest(self.poses(poses)?);
        let offsets = self.task.goals.iter().flat_map(|goal| {
            let (off, turn) = (goal.off(&state), goal.turned(&state).unwrap_or(0.0));
            [off.x, off.y, turn]
        });
        arrays::array(py, offsets.collect(), [self.task.goals.len(), 3])
    }

    /// Returns the task with the keys of a task file, for `Task.from_dict`.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        dict(py, &self.task.to_json())
    }

    /// Returns the text of a task file (YAML).
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
