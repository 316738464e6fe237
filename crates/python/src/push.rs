//! Pushes given by the caller or stored in plans.

use pushplan::planning::{ManualPush, ManualStart};
use pushplan::{Push, Vector};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;

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
///     Direction of travel, radians from world +x.
/// length : float, optional
///     Travel, metres, above 0 and at most 2; by default the task's.
/// speed : float, optional
///     Speed, m/s, above 0 and at most 2; by default the task's.
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
        start: Option<[f64; 2]>,
        direction: f64,
        length: Option<f64>,
        speed: Option<f64>,
    ) -> PyResult<Self> {
        let at = |[x, y]: [f64; 2]| ManualStart::At(Vector::new(x, y));
        checked(ManualPush { start: start.map_or(ManualStart::Last, at), direction, length, speed })
    }

    /// Creates a push that starts just before an object.
    ///
    /// Parameters
    /// ----------
    /// object : str
    ///     Name of the object.
    /// direction : float
    ///     Direction of travel, radians from world +x.
    /// offset : float, default 0
    ///     Lateral offset of the object's centre from the centre line of the tool's face, metres,
    ///     positive to the left.
    /// length : float, optional
    ///     Travel, metres; by default the task's.
    /// speed : float, optional
    ///     Speed, m/s; by default the task's.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If a number is not finite or out of range.
    #[staticmethod]
    #[pyo3(signature = (object, direction, offset = 0.0, length = None, speed = None))]
    fn before(
        object: String,
        direction: f64,
        offset: f64,
        length: Option<f64>,
        speed: Option<f64>,
    ) -> PyResult<Self> {
        let start = ManualStart::Before { object, offset };
        checked(ManualPush { start, direction, length, speed })
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

fn checked(push: ManualPush) -> PyResult<PyPush> {
    let place = match &push.start {
        ManualStart::At(at) => [at.x, at.y],
        ManualStart::Last => [0.0; 2],
        ManualStart::Before { offset, .. } => [*offset, 0.0],
    };
    if !(place.iter().all(|value| value.is_finite()) && push.direction.is_finite()) {
        return Err(PyValueError::new_err(
            "`start`, `offset` and `direction` of a push must be finite numbers",
        ));
    }
    for (name, value) in [("length", push.length), ("speed", push.speed)] {
        if let Some(found) = value.filter(|value| !(*value > 0.0 && *value <= MOST)) {
            let unit = if name == "speed" { "m/s" } else { "m" };
            let message =
                format!("{name} must be above 0 and at most {MOST} {unit}, found {found}");
            return Err(PyValueError::new_err(message));
        }
    }
    Ok(PyPush(push))
}
