//! Conversion between numbers and NumPy arrays; every function documents the shape.

use numpy::ndarray::{ArrayViewD, Axis};
use numpy::{
    AllowTypeChange, Element, IntoPyArray, PyArray, PyArray1, PyArray2, PyArrayLikeDyn,
    PyArrayMethods,
};
use pushplan::{Pose, State, Trajectory};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arguments::found;

/// Array of numbers, or nested lists of numbers.
pub type Numbers<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// Converts `values` in row-major order to an array of this shape.
pub fn array<'py, T: Element, const N: usize>(
    py: Python<'py>,
    values: Vec<T>,
    shape: [usize; N],
) -> PyResult<Bound<'py, PyArray<T, numpy::ndarray::Dim<[usize; N]>>>>
where
    numpy::ndarray::Dim<[usize; N]>: numpy::ndarray::Dimension,
    [usize; N]: numpy::ndarray::IntoDimension<Dim = numpy::ndarray::Dim<[usize; N]>>,
{
    PyArray1::from_vec(py, values).reshape(shape)
}

/// Converts poses to an array `[objects, 3]`: x and y in metres, heading in radians.
pub fn poses<'py>(py: Python<'py>, poses: &[Pose]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    array(py, poses.iter().flat_map(numbers).collect(), [poses.len(), 3])
}

/// Returns x, y and heading.
pub fn numbers(pose: &Pose) -> [f64; 3] {
    [pose.position.x, pose.position.y, pose.heading]
}

/// Returns the times of all frames, seconds: `[frames]`.
pub fn times<'py>(py: Python<'py>, trajectory: &Trajectory) -> Bound<'py, PyArray1<f64>> {
    let times: Vec<f64> = trajectory.frames.iter().map(|frame| frame.time).collect();
    times.into_pyarray(py)
}

/// Returns a state at rest with the poses of an array `[objects, 3]`.
pub fn state(poses: ArrayViewD<'_, f64>) -> State {
    let pose = |row: ArrayViewD<'_, f64>| Pose::new(row[[0]], row[[1]], row[[2]]);
    State::at_rest(poses.axis_iter(Axis(0)).map(pose).collect())
}

/// Converts an argument to an array of finite numbers; `shape` is the expected one.
pub fn numbers_of<'py>(
    what: &str,
    given: &Bound<'py, PyAny>,
    shape: &str,
) -> PyResult<Numbers<'py>> {
    let numbers: Numbers<'py> = given.extract().map_err(|_| {
        PyTypeError::new_err(format!(
            "`{what}` must be an array of numbers of the shape {shape}, found {}",
            found(given)
        ))
    })?;
    finite(what, &numbers.as_array())?;
    Ok(numbers)
}

/// Refuses numbers that are not finite.
pub fn finite(what: &str, values: &ArrayViewD<'_, f64>) -> PyResult<()> {
    match values.iter().all(|value| value.is_finite()) {
        true => Ok(()),
        false => {
            let message = format!("`{what}` contains numbers that are not finite; replace them");
            Err(PyValueError::new_err(message))
        }
    }
}
