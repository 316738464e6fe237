//! Pushes given by the caller or stored in plans.

use pushplan::planning::{ManualPush, ManualStart};
use pushplan::{Push, Vector};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::arguments;

/// Maximum length (metres) and speed (m/s) of a push, as in the command.
pub const MOST: f64 = 2.0;

/// Straight push of the end effector.
///
/// Parameters
/// ----------
/// start : sequence of float or None
///     Position of the end effector at the start, `[x, y]` in metres. With `None` the push starts
///     where the last one ended, or at the robot's home (chained pushes only).
/// direction : float
///     Direction of travel, radians from world +x, -4 pi to 4 pi.
/// length : float, optional
///     Travel, metres, above 0 and at most 2; by default the task's.
/// speed : float, optional
///     Speed, m/s, above 0 and at most 2; by default the task's.
///
/// Raises
/// ------
/// TypeError or ValueError
///     If an argument is no number, not finite or out of range.
///
/// Examples
/// --------
/// >>> pushplan.Push([0.47, 0.02], math.pi, length=0.2)
/// >>> pushplan.Push.before("can", math.pi, length=0.2)
#[pyclass(name = "Push", module = "pushplan", frozen, eq)]
#[derive(Clone, PartialEq)]
pub struct PyPush(pub ManualPush);

#[pymethods]
impl PyPush {
    /// Creates a push from a position, or after the last push.
    #[new]
    #[pyo3(signature = (start, direction, length = None, speed = None))]
    fn new(
        #[pyo3(from_py_with = place)] start: Option<[f64; 2]>,
        #[pyo3(from_py_with = direction)] direction: f64,
        #[pyo3(from_py_with = length)] length: Option<f64>,
        #[pyo3(from_py_with = speed)] speed: Option<f64>,
    ) -> PyResult<Self> {
        let at = |[x, y]: [f64; 2]| ManualStart::At(Vector::new(x, y));
        let start = start.map_or(ManualStart::Last, at);
        Ok(Self(ManualPush { start, direction, length, speed }))
    }

    /// Creates a push that starts just before an object.
    ///
    /// Parameters
    /// ----------
    /// object : str
    ///     Name of the object.
    /// direction : float
    ///     Direction of travel, radians from world +x, -4 pi to 4 pi.
    /// offset : float, default 0
    ///     Lateral offset of the object's centre from the centre line of the tool's face, metres,
    ///     positive to the left.
    /// length : float, optional
    ///     Travel, metres; by default the task's.
    /// speed : float, optional
    ///     Speed, m/s; by default the task's.
    ///
    /// Returns
    /// -------
    /// Push
    ///     Push whose start follows from the tool and the pose of the object.
    ///
    /// Raises
    /// ------
    /// TypeError or ValueError
    ///     If an argument is no number, not finite or out of range.
    ///
    /// Examples
    /// --------
    /// >>> push = pushplan.Push.before("can", math.pi, length=0.15)
    #[staticmethod]
    #[pyo3(signature = (object, direction, offset = 0.0, length = None, speed = None))]
    fn before(
        object: String,
        #[pyo3(from_py_with = direction)] direction: f64,
        #[pyo3(from_py_with = offset)] offset: f64,
        #[pyo3(from_py_with = length)] length: Option<f64>,
        #[pyo3(from_py_with = speed)] speed: Option<f64>,
    ) -> PyResult<Self> {
        let start = ManualStart::Before { object, offset };
        Ok(Self(ManualPush { start, direction, length, speed }))
    }

    /// Position of the end effector at the start, metres; `None` if the push does not state it.
    #[getter]
    fn start(&self) -> Option<(f64, f64)> {
        match &self.0.start {
            ManualStart::At(at) => Some((at.x, at.y)),
            _ => None,
        }
    }

    /// Object before which the push starts; `None` unless `Push.before` created it.
    #[getter]
    fn object(&self) -> Option<&str> {
        match &self.0.start {
            ManualStart::Before { object, .. } => Some(object),
            _ => None,
        }
    }

    /// Lateral offset of `object`, metres; `None` unless `Push.before` created the push.
    #[getter]
    fn offset(&self) -> Option<f64> {
        match &self.0.start {
            ManualStart::Before { offset, .. } => Some(*offset),
            _ => None,
        }
    }

    /// Direction of travel, radians from world +x.
    #[getter]
    fn direction(&self) -> f64 {
        self.0.direction
    }

    /// Travel, metres; `None` stands for the task's length.
    #[getter]
    fn length(&self) -> Option<f64> {
        self.0.length
    }

    /// Speed, m/s; `None` stands for the task's speed.
    #[getter]
    fn speed(&self) -> Option<f64> {
        self.0.speed
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let class = py.import("pushplan")?.getattr("Push")?;
        let ManualPush { start, direction, length, speed } = &self.0;
        let (direction, length, speed) = (*direction, *length, *speed);
        match start {
            ManualStart::At(at) => {
                let start = Some((at.x, at.y));
                Ok((class, (start, direction, length, speed)).into_pyobject(py)?.into_any())
            }
            ManualStart::Last => {
                let start = None::<(f64, f64)>;
                Ok((class, (start, direction, length, speed)).into_pyobject(py)?.into_any())
            }
            ManualStart::Before { object, offset } => {
                let arguments = (object.as_str(), direction, *offset, length, speed);
                Ok((class.getattr("before")?, arguments).into_pyobject(py)?.into_any())
            }
        }
    }

    fn __repr__(&self) -> String {
        let ManualPush { start, direction, length, speed } = &self.0;
        let mut words = match start {
            ManualStart::At(at) => format!("Push(({}, {}), {direction}", at.x, at.y),
            ManualStart::Last => format!("Push(None, {direction}"),
            ManualStart::Before { object, offset } => {
                format!("Push.before({object:?}, {direction}, offset={offset}")
            }
        };
        for (name, value) in [("length", length), ("speed", speed)] {
            words += &value.map_or(String::new(), |value| format!(", {name}={value}"));
        }
        words + ")"
    }
}

impl From<&Push> for PyPush {
    fn from(push: &Push) -> Self {
        let Push { start, direction, length, speed } = *push;
        let (length, speed) = (Some(length), Some(speed));
        Self(ManualPush { start: ManualStart::At(start), direction, length, speed })
    }
}

fn place(given: &Bound<'_, PyAny>) -> PyResult<Option<[f64; 2]>> {
    if given.is_none() {
        return Ok(None);
    }
    let place: Option<[f64; 2]> = given.extract().ok();
    match place.filter(|place| place.iter().all(|value| value.is_finite())) {
        Some(place) => Ok(Some(place)),
        None => Err(PyValueError::new_err(format!(
            "`start` must be two finite numbers, x and y in metres, or None to continue from \
             the last push, found {}",
            given.repr()?
        ))),
    }
}

fn direction(given: &Bound<'_, PyAny>) -> PyResult<f64> {
    arguments::angle("direction", arguments::number("direction", given)?)
}

fn offset(given: &Bound<'_, PyAny>) -> PyResult<f64> {
    let offset = arguments::number("offset", given)?;
    if offset.abs() <= MOST {
        return Ok(offset);
    }
    let message = format!("`offset` must be from -{MOST} to {MOST} m, found {offset}; give metres");
    Err(PyValueError::new_err(message))
}

fn length(given: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    above_zero("length", "m", given)
}

fn speed(given: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    above_zero("speed", "m/s", given)
}

fn above_zero(name: &str, unit: &str, given: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    if given.is_none() {
        return Ok(None);
    }
    let value = arguments::number(name, given)?;
    if value > 0.0 && value <= MOST {
        return Ok(Some(value));
    }
    let message =
        format!("`{name}` must be above 0 and at most {MOST} {unit}, found {value}; give {unit}");
    Err(PyValueError::new_err(message))
}
