//! Arguments that must be objects of the package, with advice for other values.

use pyo3::PyClass;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::arguments::found;
use crate::belief::PyRecording;
use crate::plan::PyPlan;
use crate::push::PyPush;
use crate::solution::PySolution;
use crate::table_fit::PyTableFit;
use crate::task::PyTask;
use crate::tool::{PyTool, PyToolLibrary};
use crate::trajectory::PyTrajectory;

const TASK: &str = "read a file with `pushplan.Task.load(path)`, take a shipped task with \
                    `pushplan.Task.example(name)`, or build one with `pushplan.Task.from_dict`";
const PLAN: &str = "read a file with `pushplan.Plan.load(path)`, or build one with \
                    `pushplan.Plan.of`";
const LIBRARY: &str = "use `pushplan.ToolLibrary.load(folder)`, or \
                       `pushplan.ToolLibrary.of(tools)` for a list of tools";

/// Converts a task.
pub fn task(given: &Bound<'_, PyAny>) -> PyResult<Py<PyTask>> {
    one("task", "a `pushplan.Task`", given, || match holds_task(given) {
        true => "use its attribute `task`",
        false => TASK,
    })
}

/// Converts a sequence of tasks.
pub fn tasks(given: &Bound<'_, PyAny>) -> PyResult<Vec<Py<PyTask>>> {
    many("tasks", "a list of `pushplan.Task`", given, TASK)
}

/// Converts a plan.
pub fn plan(given: &Bound<'_, PyAny>) -> PyResult<Py<PyPlan>> {
    one("plan", "a `pushplan.Plan`", given, || {
        if given.is_instance_of::<PySolution>() {
            "use the best plan of the solution, `solution.best`"
        } else if given.is_none() {
            "no push is feasible if `solution.best` is None; see `solution.cause`"
        } else {
            PLAN
        }
    })
}

/// Converts a tool library, if one is given.
pub fn tools(given: &Bound<'_, PyAny>) -> PyResult<Option<Py<PyToolLibrary>>> {
    maybe("tools", "a `pushplan.ToolLibrary`", given, LIBRARY)
}

/// Converts a tool.
pub fn tool(given: &Bound<'_, PyAny>) -> PyResult<Py<PyTool>> {
    one("tool", "a `pushplan.Tool`", given, || {
        "read a file with `pushplan.Tool.load(path)`, or take one from a library with \
         `library[name]`"
    })
}

/// Converts a sequence of tools.
pub fn list_of_tools(given: &Bound<'_, PyAny>) -> PyResult<Vec<Py<PyTool>>> {
    let advice = "read files with `pushplan.Tool.load(path)`, and pass one tool as `[tool]`";
    many("tools", "a list of `pushplan.Tool`", given, advice)
}

/// Converts a sequence of pushes.
pub fn pushes(given: &Bound<'_, PyAny>) -> PyResult<Vec<Py<PyPush>>> {
    let advice = "create each with `pushplan.Push([x, y], direction, length)` or \
                  `pushplan.Push.before(object, direction)`, and pass one push as `[push]`";
    many("pushes", "a list of `pushplan.Push`", given, advice)
}

/// Converts a recording.
pub fn recording(given: &Bound<'_, PyAny>) -> PyResult<Py<PyRecording>> {
    one(
        "recording",
        "a `pushplan.Recording`",
        given,
        || "read a file with `pushplan.Recording.load(path)`, or a log with `pushplan.logs`",
    )
}

/// Converts a sequence of recordings.
pub fn recordings(given: &Bound<'_, PyAny>) -> PyResult<Vec<Py<PyRecording>>> {
    let advice = "read files with `pushplan.Recording.load(path)`, and pass one recording as \
                  `[recording]`";
    many("recordings", "a list of `pushplan.Recording`", given, advice)
}

/// Converts a table fit, if one is given.
pub fn fit(given: &Bound<'_, PyAny>) -> PyResult<Option<Py<PyTableFit>>> {
    let advice = "read a file with `pushplan.TableFit.load(path)`, or fit recordings with \
                  `pushplan.fit(recordings)`";
    maybe("fit", "a `pushplan.TableFit`", given, advice)
}

/// Converts a trajectory, if one is given.
pub fn trajectory(given: &Bound<'_, PyAny>) -> PyResult<Option<Py<PyTrajectory>>> {
    let advice = "predict the plan with `pushplan.predict(plan)`, or take the attribute \
                  `trajectory` of a plan or a replay";
    maybe("trajectory", "a `pushplan.Trajectory`", given, advice)
}

/// Returns the error of a class without a constructor, such as `Task()`.
pub fn no_constructor(class: &str, remedy: &str) -> PyErr {
    PyTypeError::new_err(format!("`pushplan.{class}` has no constructor; {remedy}"))
}

fn holds_task(given: &Bound<'_, PyAny>) -> bool {
    given.is_instance_of::<PySolution>() || given.is_instance_of::<PyPlan>()
}

fn one<T: PyClass>(
    name: &str,
    expected: &str,
    given: &Bound<'_, PyAny>,
    advice: impl FnOnce() -> &'static str,
) -> PyResult<Py<T>> {
    given.cast::<T>().map(|found| found.clone().unbind()).map_err(|_| {
        let found = found(given);
        PyTypeError::new_err(format!("`{name}` must be {expected}, found {found}; {}", advice()))
    })
}

fn maybe<T: PyClass>(
    name: &str,
    expected: &str,
    given: &Bound<'_, PyAny>,
    advice: &'static str,
) -> PyResult<Option<Py<T>>> {
    if given.is_none() { Ok(None) } else { one(name, expected, given, || advice).map(Some) }
}

fn many<T: PyClass>(
    name: &str,
    expected: &str,
    given: &Bound<'_, PyAny>,
    advice: &'static str,
) -> PyResult<Vec<Py<T>>> {
    let wrong = |given: &Bound<'_, PyAny>, place: &str| {
        let found = found(given);
        PyTypeError::new_err(format!("`{name}` must be {expected}, found {found}{place}; {advice}"))
    };
    // The items of a text are characters.
    let items = given.try_iter().map_err(|_| wrong(given, ""))?;
    if given.extract::<String>().is_ok() {
        return Err(wrong(given, ""));
    }
    let item = |(k, item): (usize, PyResult<Bound<'_, PyAny>>)| {
        let item = item?;
        let right = item.cast::<T>().map(|right| right.clone().unbind());
        right.map_err(|_| wrong(&item, &format!(" at index {k}")))
    };
    items.enumerate().map(item).collect()
}
