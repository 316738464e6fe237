//! Pushes as requested by the caller, and as stored in plans.

use pushplan::solve::{ManualPush, ManualStart};
use pushplan::{Push, Vector};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyAny;

/// Maximum length (metres) and speed (m/s) of a push, as in the command.
pub const MOST: f64 = 2.0;

/// One straight push of the end effector.
#[pyclass(name = "Push", module = "pushplan", frozen, eq)]
#[derive(Clone, PartialEq)]
pub struct PyPush(pub ManualPush);

#[pymethods]
impl PyPush {
    /// A push from `start`, the end effector's position [x, y] in metres; `None` goes on where the
    /// last one ended, or from home (chained pushes). `direction` is in radians from world +x;
    /// `length` (metres) and `speed` (m/s) are the task's if not given.
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

    /// A push that begins just before the object of this name, its centre `offset` metres left of
    /// the centre line of the tool's face.
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

    /// The end effector's position at the start, metres, where it is known.
    #[getter]
    fn start(&self) -> Option<(f64, f64)> {
        match &self.0.start {
            ManualStart::At(at) => Some((at.x, at.y)),
            _ => None,
        }
    }

    /// The object before which it begins, where that was asked for.
    #[getter]
    fn object(&self) -> Option<&str> {
        match &self.0.start {
            ManualStart::Before { object, .. } => Some(object),
            _ => None,
        }
    }

    /// Lateral offset of that object, metres.
    #[getter]
    fn offset(&self) -> Option<f64> {
        match &self.0.start {
            ManualStart::Before { offset, .. } => Some(*offset),
            _ => None,
        }
    }

    /// Where it goes, radians from world +x.
    #[getter]
    fn direction(&self) -> f64 {
        self.0.direction
    }

    /// Travel, metres; `None` for the task's.
    #[getter]
    fn length(&self) -> Option<f64> {
        self.0.length
    }

    /// Speed, m/s; `None` for the task's.
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
        return Err(PyValueError::new_err("start, offset and direction must be finite"));
    }
    for (name, value) in [("length", push.length), ("speed", push.speed)] {
        if value.is_some_and(|value| !(value > 0.0 && value <= MOST)) {
            let message = format!("{name} must be above 0 and at most {MOST}");
            return Err(PyValueError::new_err(message));
        }
    }
    Ok(PyPush(push))
}
