//! Import and export of other formats.

use std::ffi::CString;
use std::path::PathBuf;
use std::sync::Arc;

use pushplan::Vector;
use pushplan::files::{Faults, write_atomic};
use pushplan_import::{Imported, Model, Reading, Wanted};
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::prelude::*;

use crate::plan::PyPlan;
use crate::predict::predicted;
use crate::task::PyTask;
use crate::tool::PyTool;
use crate::trajectory::PyTrajectory;
use crate::{arguments, errors, wanted, work};

// Defaults are literals, because Python shows them; the friction must equal `Wanted::FRICTION`.
const _: () = assert!(Wanted::FRICTION == 0.5);

/// Allows the URDF files of arms to name meshes in and below a folder, until the process ends.
///
/// Otherwise, meshes must be in or below the folder of the URDF. A task cannot allow a folder,
/// because tasks may come from other people.
///
/// Parameters
/// ----------
/// folder : str or path-like
///     Folder, such as the one that contains the packages named by `package://`.
///
/// Examples
/// --------
/// >>> pushplan.allow_files_in("ros/share")
#[pyfunction]
pub fn allow_files_in(folder: PathBuf) {
    pushplan_arm::allow_files_in(folder);
}

/// Imports a tool from a MuJoCo (MJCF), ROS (URDF) or mesh (STL, OBJ) file.
///
/// The command `pushplan import --help` lists the supported elements. Small differences between
/// file and tool give warnings of the class `UserWarning`.
///
/// Parameters
/// ----------
/// path : str or path-like
///     File to import.
/// body : str, optional
///     Body of the tool, with all bodies fixed to it; by default the only body of the file.
/// name : str, optional
///     Name of the tool; by default from the file.
/// friction : float, default 0.5
///     Friction value of bodies that state none.
/// root : str or path-like, optional
///     Folder that must contain all files to which the file refers; by default its own folder.
/// unit : float, optional
///     Unit of a mesh file, metres, such as 0.001 for millimetres; by default metres, or the unit
///     that makes it an object on a table.
///
/// Returns
/// -------
/// Tool
///     Imported tool.
///
/// Raises
/// ------
/// FileError
///     If the file is unreadable, or pushplan cannot express a part of it.
/// ValueError
///     If `unit` is not a number above 0.
///
/// Examples
/// --------
/// >>> tool = pushplan.import_tool("hook.xml", friction=0.4)
#[pyfunction]
#[pyo3(signature = (path, *, body = None, name = None, friction = 0.5, root = None, unit = None))]
pub fn import_tool(
    py: Python<'_>,
    path: PathBuf,
    body: Option<String>,
    name: Option<String>,
    friction: f64,
    root: Option<PathBuf>,
    unit: Option<f64>,
) -> PyResult<PyTool> {
    let bodies = body.into_iter().collect();
    let wanted = Wanted { bodies, name, friction, ..Wanted::default() };
    let tool = imported(py, path, &reading(root, unit, false)?, &wanted, pushplan_import::tool)?;
    Ok(PyTool(Arc::new(tool)))
}

/// Imports a task with the objects and obstacles of a MuJoCo (MJCF), ROS (URDF) or mesh file.
///
/// Robot and tools of the task are placeholders. The goal is the position of the first object,
/// unless `export_mjcf` wrote the file. Small differences between file and task give warnings of
/// the class `UserWarning`.
///
/// Parameters
/// ----------
/// path : str or path-like
///     File to import.
/// bodies : sequence of str, optional
///     Bodies to import as objects; by default all bodies that move freely.
/// name : str, optional
///     Name of the task; by default from the file.
/// friction : float, default 0.5
///     Friction value of bodies that state none.
/// shift : tuple of float, default (0, 0)
///     Translation of everything on the table, x and y in metres.
/// free : sequence of str, optional
///     Bodies that become free objects although the file fixes them.
/// density : float, optional
///     Density of bodies that state no mass, kg/m^3; by default 1000, with unknown masses.
/// root : str or path-like, optional
///     Folder that must contain all files to which the file refers; by default its own folder.
/// unit : float, optional
///     Unit of a mesh file, metres; by default metres, or the unit that makes it an object on a
///     table.
/// fixed : bool, default False
///     Whether free bodies to which others are jointed are fixed, like a cabinet against a wall.
/// strict : bool, default False
///     Whether a missing unit, mass or free body is an error instead of an assumption.
///
/// Returns
/// -------
/// Task
///     Imported task.
///
/// Raises
/// ------
/// FileError
///     If the file is unreadable, or pushplan cannot express a part of it.
/// ValueError
///     If `density` or `unit` is not a number above 0.
///
/// Examples
/// --------
/// >>> task = pushplan.import_task("scene.xml", shift=(0.1, 0.0))
#[pyfunction]
#[pyo3(signature = (path, *, bodies = None, name = None, friction = 0.5, shift = (0.0, 0.0),
                    free = None, density = None, root = None, unit = None, fixed = false,
                    strict = false))]
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
    unit: Option<f64>,
    fixed: bool,
    strict: bool,
) -> PyResult<PyTask> {
    let (bodies, shift) = (bodies.unwrap_or_default(), Vector::new(shift.0, shift.1));
    if let Some(found) = density.filter(|density| !(*density > 0.0 && density.is_finite())) {
        let message = format!("`density` must be a number above 0, kg/m^3, found {found}");
        return Err(PyValueError::new_err(message));
    }
    let free = free.unwrap_or_default();
    let wanted = Wanted { bodies, free, fixed, density, name, friction, shift };
    let reading = reading(root, unit, strict)?;
    let scene = imported(py, path, &reading, &wanted, pushplan_import::objects)?;
    Ok(PyTask { task: Arc::new(scene.task), source: None })
}

fn reading(root: Option<PathBuf>, unit: Option<f64>, strict: bool) -> PyResult<Reading> {
    if let Some(unit) = unit.filter(|unit| !(*unit > 0.0 && unit.is_finite())) {
        let message = format!("`unit` must be a number above 0, metres, found {unit}");
        return Err(PyValueError::new_err(message));
    }
    Ok(Reading { root, unit, strict })
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
    let (model, _) = pushplan_import::read(&path, reading).map_err(faults)?;
    let made = way(&model, &path.display().to_string(), wanted).map_err(faults)?;
    for note in made.notes {
        let note = CString::new(note.replace('\0', " ")).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &note, 1)?;
    }
    Ok(made.value)
}

/// Writes a plan as a MuJoCo scene (MJCF) with pushes and goal: the text of `Plan.to_mjcf`.
///
/// Parameters
/// ----------
/// plan : Plan
///     Plan to export.
/// path : str or path-like
///     File to write, in an existing folder. It is replaced as a whole, so that no partial file
///     remains after an error.
///
/// Raises
/// ------
/// FileError
///     If the file cannot be written.
///
/// Examples
/// --------
/// >>> pushplan.export_mjcf(plan, "best.xml")
#[pyfunction]
pub fn export_mjcf(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::plan)] plan: Py<PyPlan>,
    path: PathBuf,
) -> PyResult<()> {
    let text = plan.get().to_mjcf()?;
    write_atomic(path, text.as_bytes()).map_err(|faults| errors::files(py, &faults, None))
}

/// Writes a plan and its motion as MCAP, for viewers such as Foxglove and Rerun.
///
/// Solids are `foxglove.SceneUpdate` messages on `/scene`. Poses are `foxglove.FrameTransforms` on
/// `/tf` and plain numbers on `/state`. The plan file is an attachment.
///
/// Parameters
/// ----------
/// plan : Plan
///     Plan to export.
/// path : str or path-like
///     File to write, in an existing folder. It is replaced as a whole, so that no partial file
///     remains after an error.
/// trajectory : Trajectory, optional
///     Motion to write, from `predict` or a replay of a verdict; by default the prediction of
///     `model`.
/// model : str, default "3d"
///     Model of the default motion.
/// threads : int, default 0
///     Number of worker threads; 0 means one per core.
///
/// Raises
/// ------
/// FileError
///     If the file cannot be written.
/// ModelError
///     If `model` is not the name of an effect model.
/// TypeError or ValueError
///     If an argument has an invalid type, or `trajectory` belongs to another task.
///
/// Examples
/// --------
/// >>> pushplan.export_mcap(plan, "best.mcap", trajectory=pushplan.predict(plan))
#[pyfunction]
#[pyo3(signature = (plan, path, *, trajectory = None, model = "3d", threads = 0))]
pub fn export_mcap(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::plan)] plan: Py<PyPlan>,
    path: PathBuf,
    #[pyo3(from_py_with = wanted::trajectory)] trajectory: Option<Py<PyTrajectory>>,
    model: &str,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
) -> PyResult<()> {
    let plan = plan.get();
    let trajectory = match &trajectory {
        Some(known) => known.get().trajectory.clone(),
        None => {
            let model = arguments::model(py, model, arguments::out_of_range("warn")?)?;
            work::run(py, threads, |_| predicted(&model, &plan.file))?
        }
    };
    let objects = plan.file.task.scene.objects.len();
    if trajectory.frames.iter().any(|frame| frame.state.poses.len() != objects) {
        let message = format!(
            "`trajectory` is of another task: the plan's task has {objects} objects; predict the \
             plan with `pushplan.predict`"
        );
        return Err(PyValueError::new_err(message));
    }
    let bytes = pushplan_export::mcap(&plan.file, &trajectory)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    write_atomic(path, &bytes).map_err(|faults| errors::files(py, &faults, None))
}
