//! Trajectories of objects and tool.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArray3};
use pushplan::{Outcome, Task, Trajectory, Warning};
use pyo3::prelude::*;
use pyo3::types::PyAny;
use serde_json::json;

use crate::{arrays, json};

/// Motion of objects and tool under one model, frame by frame until all objects rest.
#[pyclass(name = "Trajectory", module = "pushplan", frozen)]
pub struct PyTrajectory {
    pub trajectory: Trajectory,
    outcome: Outcome,
    objects: Vec<String>,
}

#[pymethods]
impl PyTrajectory {
    /// Name of the model that computed the motion.
    #[getter]
    fn model(&self) -> String {
        self.trajectory.by.to_string()
    }

    /// Names of the objects, in the order of `poses`.
    #[getter]
    fn objects(&self) -> Vec<String> {
        self.objects.clone()
    }

    /// Time of every frame since the start, seconds: `[frames]`.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::times(py, &self.trajectory)
    }

    /// Poses of all objects, `[frames, objects, 3]`: x and y in metres, heading in radians.
    /// Headings are continuous, without wrapping at pi.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let frames = &self.trajectory.frames;
        let things = self.objects.len();
        let poses = frames.iter().flat_map(|frame| frame.state.poses.iter().take(things));
        let numbers = poses.flat_map(arrays::numbers).collect();
        arrays::array(py, numbers, [frames.len(), self.objects.len(), 3])
    }

    /// 3-D poses of all objects, `[frames, objects, 7]`: x, y and z in metres, and the quaternion
    /// x, y, z, w. `None` if no object leaves the plane.
    #[getter]
    fn space<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray3<f64>>>> {
        let frames = &self.trajectory.frames;
        let mut numbers = Vec::new();
        for frame in frames {
            let Some(space) = &frame.state.space else { return Ok(None) };
            for pose in space {
                numbers.extend(pose.position.iter());
                numbers.extend(pose.quaternion());
            }
        }
        arrays::array(py, numbers, [frames.len(), self.objects.len(), 7]).map(Some)
    }

    /// Rise of the levered edge at the end of each lever-up, metres.
    #[getter]
    fn raised(&self) -> Vec<f64> {
        self.trajectory.lifts.iter().map(|lift| lift.raised).collect()
    }

    /// Poses of the tool frame, `[frames, 3]`: x and y in metres, heading in radians.
    #[getter]
    fn tool_poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let frames = &self.trajectory.frames;
        let numbers = frames.iter().flat_map(|frame| arrays::numbers(&frame.tool)).collect();
        arrays::array(py, numbers, [frames.len(), 3])
    }

    /// Final distance of the goal's object from the goal, metres.
    #[getter]
    fn error(&self) -> f64 {
        self.outcome.error()
    }

    /// Final heading error, radians; `None` if the goal states no heading.
    #[getter]
    fn heading_error(&self) -> Option<f64> {
        self.outcome.heading_error()
    }

    /// Whether the objects rest at the goal and no failure occurred before, such as a fall.
    #[getter]
    fn reached(&self) -> bool {
        self.outcome.reached
    }

    /// Warnings about the reliability of the motion.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.trajectory.warnings.iter().map(Warning::to_string).collect()
    }

    fn __len__(&self) -> usize {
        self.trajectory.frames.len()
    }

    fn __repr__(&self) -> String {
        let reached = if self.outcome.reached { "reached" } else { "not reached" };
        let (by, frames) = (&self.trajectory.by, self.trajectory.frames.len());
        format!(
            "<Trajectory of {frames} frames by {by}: goal {reached}, error {:.2} mm>",
            1e3 * self.outcome.error()
        )
    }

    /// Restores a trajectory from the text that pickle stores.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        let mut kept = json::kept(text)?;
        let mut take = |key: &str| kept[key].take();
        let trajectory = serde_json::from_value(take("trajectory")).map_err(json::damaged)?;
        let outcome = serde_json::from_value(take("outcome")).map_err(json::damaged)?;
        let objects = serde_json::from_value(take("objects")).map_err(json::damaged)?;
        Ok(Self { trajectory, outcome, objects })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::unpickled(py, "Trajectory", &self.kept())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.kept() == other.kept()
    }
}

impl PyTrajectory {
    /// Returns the data that pickle stores.
    fn kept(&self) -> serde_json::Value {
        let Self { trajectory, outcome, objects } = self;
        json!({"trajectory": trajectory, "outcome": outcome, "objects": objects})
    }

    /// Creates a trajectory for the scene of `task`, judged by its goals.
    pub fn new(task: &Arc<Task>, trajectory: Trajectory) -> Self {
        let outcome = Outcome::judge(&task.scene, task, &trajectory);
        let objects = task.scene.things().map(|(_, object)| object.name.clone()).collect();
        Self { trajectory, outcome, objects }
    }
}
