//! World of a closed-loop run, simulated or implemented in Python.

use std::sync::Arc;

use numpy::PyArray2;
use pushplan::ObservedPose;
use pushplan::{Task, Tool, ToolLibrary, ToolMotion, Vector};
use pushplan_act::act::{Look, SimulatedWorld, World, WorldError};
use pushplan_act::hidden;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::arrays::{self, Numbers};
use crate::tool::PyTool;
use crate::{arguments, errors};

/// Motion that a world executes. The robot sets the tool down at the start of the first stroke,
/// moves it along all strokes, waits until the objects rest, and lifts it.
#[pyclass(name = "Motion", module = "pushplan", frozen)]
pub struct PyMotion(ToolMotion);

#[pymethods]
impl PyMotion {
    /// Tool of the motion.
    #[getter]
    fn tool(&self) -> PyTool {
        PyTool(Arc::clone(&self.0.tool))
    }

    /// Height of the tool's underside above the table, metres.
    #[getter]
    fn lift(&self) -> f64 {
        self.0.lift
    }

    /// Poses of the end effector at start and end of every stroke, `[strokes, 6]`: x, y (metres),
    /// heading (radians), x, y, heading.
    #[getter]
    fn end_effector<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let grip = self.0.tool.grip;
        let ends = self.0.strokes.iter().flat_map(|stroke| [stroke.from * grip, stroke.to * grip]);
        let numbers = ends.flat_map(|pose| arrays::numbers(&pose)).collect();
        arrays::array(py, numbers, [self.0.strokes.len(), 6])
    }

    /// Poses of the tool frame, in the format of `end_effector`.
    #[getter]
    fn tool_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let ends = self.0.strokes.iter().flat_map(|stroke| [stroke.from, stroke.to]);
        let numbers = ends.flat_map(|pose| arrays::numbers(&pose)).collect();
        arrays::array(py, numbers, [self.0.strokes.len(), 6])
    }

    /// Duration of each stroke, seconds.
    #[getter]
    fn durations(&self) -> Vec<f64> {
        self.0.strokes.iter().map(|stroke| stroke.duration).collect()
    }

    fn __repr__(&self) -> String {
        format!("<Motion of {} strokes with {}>", self.0.strokes.len(), self.0.tool.name)
    }
}

/// World in which a run acts.
pub enum Place {
    /// World simulated by the library.
    Drawn(Box<SimulatedWorld>),
    /// World implemented by a Python object, with the exception it raised, if any.
    Theirs { object: Py<PyAny>, raised: Option<PyErr> },
}

impl Place {
    /// Converts the argument `world`: the seed of a simulated world, or an object.
    pub fn of(
        py: Python<'_>,
        task: &Task,
        library: &ToolLibrary,
        world: Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        if let Ok(number) = world.extract::<u64>() {
            let truth = hidden(task, library, number);
            let truth = truth.map_err(|faults| errors::files(py, &faults, None))?;
            let world = SimulatedWorld::new(truth).pushed_with(task.robot.max_force);
            return Ok(Place::Drawn(Box::new(world)));
        }
        if world.hasattr("look")? && world.hasattr("act")? {
            return Ok(Place::Theirs { object: world.unbind(), raised: None });
        }
        Err(PyTypeError::new_err(format!(
            "`world` must be a whole number from 0, the seed of a simulated world, or an object \
             with the methods `look` and `act`, found {}",
            arguments::found(&world)
        )))
    }

    /// Calls the Python object; an exception is kept for the caller of the run.
    fn ask<T>(
        &mut self,
        ask: impl FnOnce(Python<'_>, &Bound<'_, PyAny>) -> PyResult<T>,
    ) -> Result<T, WorldError> {
        let Place::Theirs { object, raised } = self else {
            return Err(WorldError("this world is simulated and has no Python object".to_owned()));
        };
        Python::attach(|py| {
            ask(py, object.bind(py)).map_err(|error| {
                let words = WorldError(error.to_string());
                *raised = Some(error);
                words
            })
        })
    }
}

impl World for Place {
    fn look(&mut self) -> Result<Look, WorldError> {
        match self {
            Place::Drawn(world) => world.look(),
            Place::Theirs { .. } => self.ask(|_, world| {
                let seen = sights(&world.call_method0("look")?)?;
                Ok(Look { time: 0.0, seen })
            }),
        }
    }

    fn change_tool(&mut self, tool: &Tool) -> Result<(), WorldError> {
        match self {
            Place::Drawn(_) => Ok(()),
            Place::Theirs { .. } => self.ask(|_, world| {
                if world.hasattr("change_tool")? {
                    world.call_method1("change_tool", (PyTool(Arc::new(tool.clone())),))?;
                }
                Ok(())
            }),
        }
    }

    fn act(&mut self, motion: &ToolMotion) -> Result<Vec<Look>, WorldError> {
        match self {
            Place::Drawn(world) => world.act(motion),
            Place::Theirs { .. } => self.ask(|_, world| {
                let looks = world.call_method1("act", (PyMotion(motion.clone()),))?;
                let look = |pair: Bound<'_, PyAny>| {
                    let (time, poses): (f64, Bound<'_, PyAny>) = pair.extract()?;
                    Ok(Look { time, seen: sights(&poses)? })
                };
                looks.try_iter()?.map(|pair| look(pair?)).collect()
            }),
        }
    }

    fn stopped(&self) -> Option<pushplan_act::act::Stop> {
        match self {
            Place::Drawn(world) => world.stopped(),
            Place::Theirs { .. } => None,
        }
    }

    fn save(&self) -> Option<pushplan_act::act::WorldState> {
        match self {
            Place::Drawn(world) => world.save(),
            Place::Theirs { .. } => None,
        }
    }
}

/// Converts an array `[objects, 3]` to observations.
fn sights(array: &Bound<'_, PyAny>) -> PyResult<Vec<Option<ObservedPose>>> {
    let numbers: Numbers<'_> = array.extract()?;
    let numbers = numbers.as_array();
    if numbers.ndim() != 2 || numbers.shape()[1] != 3 {
        let message = format!(
            "observed poses must have the shape [objects, 3], found {:?}; see `pushplan.run`",
            numbers.shape()
        );
        return Err(PyValueError::new_err(message));
    }
    let sight = |k: usize| {
        let [x, y, heading] = [0, 1, 2].map(|column| numbers[[k, column]]);
        let heading = heading.is_finite().then_some(heading);
        let seen = x.is_finite() && y.is_finite();
        seen.then_some(ObservedPose { position: Vector::new(x, y), heading })
    };
    Ok((0..numbers.shape()[0]).map(sight).collect())
}
