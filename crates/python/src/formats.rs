//! Import and export of other formats.

use std::ffi::CString;
use std::path::PathBuf;
use std::sync::Arc;

use pushplan::Vector;
use pushplan::asset::{Faults, write_atomic};
use pushplan_import::{Imported, Model, Reading, Wanted};
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::prelude::*;

use crate::plan::PyPlan;
use crate::solve::predicted;
use crate::task::PyTask;
use crate::tool::PyTool;
use crate::trajectory::PyTrajectory;
use crate::{arguments, errors, work};

// Defaults are literals, because Python shows them; the friction must equal `Wanted::FRICTION`.
const _: () = assert!(Wanted::FRICTION == 0.5);

/// The tool in a file of MuJoCo (MJCF) or ROS (URDF): the body of that name, by default the only one,
/// with all that is fixed to it.
///
/// `friction` is the value of bodies that state none, `root` the folder in and below which the file
/// may name others, by default its own, and `unit` that of a mesh (STL, OBJ), metres. `pushplan import
/// --help` says what is imported as what. Raises `FileError` for anything that pushplan cannot express; slight
/// differences are warnings.
#[pyfunction]
#[pyo3(signature = (path, *, body = None, name = None, friction = 0.5, root = None, unit = 1.0))]
pub fn import_tool(
    py: Python<'_>,
    path: PathBuf,
    body: Option<String>,
    name: Option<String>,
    friction: f64,
    root: Option<PathBuf>,
    unit: f64,
) -> PyResult<PyTool> {
    let bodies = body.into_iter().collect();
    let wanted = Wanted { bodies, name, friction, ..Wanted::default() };
    let tool = imported(py, path, &reading(root, unit)?, &wanted, pushplan_import::tool)?;
    Ok(PyTool(Arc::new(tool)))
}

/// A task with the objects and obstacles in a file of MuJoCo (MJCF) or ROS (URDF): all that stand
/// freely, or the bodies of those names.
///
/// Robot and tools are placeholders for yours, and so is the goal, where the first object is,
/// unless the file is one of `export_mjcf`. `friction` is the value of bodies that state none,
/// `shift` moves everything on the table (metres), `free` names bodies that stand freely although the
/// file holds them, `density` (kg/m^3) is that of bodies that state no mass, `root` the folder in and below
/// which the file may name others, by default its own, and `unit` that of a mesh, metres. Raises `FileError` for anything that pushplan
/// cannot express; slight differences are warnings.
#[pyfunction]
#[pyo3(signature = (path, *, bodies = None, name = None, friction = 0.5, shift = (0.0, 0.0),
                    free = None, density = None, root = None, unit = 1.0))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn import_task(
    py: Python<'_>,
    path: PathBuf,
    bodies: Option<Vec<String>>,
    name: Option<String>,
    friction: f64,
    shift: (f64, f64),
    free: Option<Vec<String>>,
    density: Option<f64>,
    root: Option<PathBuf>,
    unit: f64,
) -> PyResult<PyTask> {
    let (bodies, shift) = (bodies.unwrap_or_default(), Vector::new(shift.0, shift.1));
    if density.is_some_and(|density| !(density > 0.0 && density.is_finite())) {
        return Err(PyValueError::new_err("`density` is a number above 0, kg/m^3"));
    }
    let free = free.unwrap_or_default();
    let wanted = Wanted { bodies, free, density, name, friction, shift };
    let scene = imported(py, path, &reading(root, unit)?, &wanted, pushplan_import::objects)?;
    Ok(PyTask { task: Arc::new(scene.task), source: None })
}

fn reading(root: Option<PathBuf>, unit: f64) -> PyResult<Reading> {
    if !(unit > 0.0 && unit.is_finite()) {
        return Err(PyValueError::new_err("`unit` is a number above 0, metres"));
    }
    Ok(Reading { root, unit })
}

/// Runs an import of the library on a file and converts its notes to warnings.
fn imported<T>(
    py: Python<'_>,
    path: PathBuf,
    reading: &Reading,
    wanted: &Wanted,
    way: fn(&Model, &str, &Wanted) -> Result<Imported<T>, Faults>,
) -> PyResult<T> {
    let faults = |faults: Faults| errors::files(py, &faults, None);
    let (model, _, mut notes) = pushplan_import::read(&path, reading).map_err(faults)?;
    let made = way(&model, &path.display().to_string(), wanted).map_err(faults)?;
    notes.extend(made.notes);
    for note in notes {
        let note = CString::new(note.replace('\0', " ")).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &note, 1)?;
    }
    Ok(made.value)
}

/// Writes a plan as a scene of MuJoCo (MJCF), pushes and goal included: the text of `Plan.to_mjcf`. A
/// partial file is never left behind.
#[pyfunction]
pub fn export_mjcf(py: Python<'_>, plan: &PyPlan, path: PathBuf) -> PyResult<()> {
    let text = plan.to_mjcf()?;
    write_atomic(path, text.as_bytes()).map_err(|faults| errors::files(py, &faults, None))
}

/// Writes a plan and what it does as MCAP, which viewers such as Foxglove and Rerun play: solids as
/// `foxglove.SceneUpdate` on `/scene`, poses as `foxglove.FrameTransforms` on `/tf` and as plain
/// numbers on `/state`, the plan file as an attachment.
///
/// What it does is `trajectory` (of `predict`, of a replay of a verdict), by default what `model` says.
/// A partial file is never left behind.
#[pyfunction]
#[pyo3(signature = (plan, path, *, trajectory = None, model = "3d", threads = 0))]
pub fn export_mcap(
    py: Python<'_>,
    plan: &PyPlan,
    path: PathBuf,
    trajectory: Option<Py<PyTrajectory>>,
    model: &str,
    threads: usize,
) -> PyResult<()> {
    let trajectory = match &trajectory {
        Some(known) => known.get().trajectory.clone(),
        None => {
            let model = arguments::model(py, model, arguments::out_of_range("warn")?)?;
            work::run(py, arguments::threads(threads)?, |_| predicted(&model, &plan.file))?
        }
    };
    let objects = plan.file.task.scene.objects.len();
    if trajectory.frames.iter().any(|frame| frame.state.poses.len() != objects) {
        let message = format!("`trajectory` is of another task: the plan's has {objects} objects");
        return Err(PyValueError::new_err(message));
    }
    let bytes = pushplan_export::mcap(&plan.file, &trajectory)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    write_atomic(path, &bytes).map_err(|faults| errors::files(py, &faults, None))
}
