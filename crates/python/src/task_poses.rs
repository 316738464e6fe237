//! Poses and sources of tasks.

use std::sync::Arc;

use pushplan::{Pose, Task};
use pushplan_report::TaskSource;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays;
use crate::task::PyTask;

/// Maximum distance of an object beyond the reach of the robot, metres. Objects that fall or roll
/// away stay nearer, and millimetres are farther.
const BEYOND: f64 = 2.0;
/// Maximum rotation of an object, radians: four revolutions, because headings are continuous.
const TURNED: f64 = 8.0 * std::f64::consts::PI;

impl PyTask {
    /// Returns the source of the task for a command line.
    pub fn source(&self) -> TaskSource {
        let unread = || TaskSource::File(format!("{}.yaml", self.task.name));
        self.source.clone().unwrap_or_else(unread)
    }

    /// Converts an array to the poses of the task's objects.
    pub fn poses(&self, given: &Bound<'_, PyAny>) -> PyResult<Vec<Pose>> {
        let objects = self.task.scene.things().count();
        let poses = arrays::numbers_of("poses", given, &format!("[{objects}, 3]"))?;
        let poses = poses.as_array();
        if *poses.shape() != [objects, 3] {
            let message = format!(
                "`poses` must have the shape [{objects}, 3], one row of x, y and heading per \
                 object, found {:?}",
                poses.shape()
            );
            return Err(PyValueError::new_err(message));
        }
        let poses = arrays::state(poses).poses;
        let far = self.task.robot.reach_max + BEYOND;
        for ((_, object), pose) in self.task.scene.things().zip(&poses) {
            let (away, name) = (pose.position.norm(), &object.name);
            if away > far {
                return Err(PyValueError::new_err(format!(
                    "`poses`: {name} is {away:.1} m from the robot, at most {far:.1} m are \
                     possible; give x and y in metres, with the robot's base at the origin"
                )));
            }
            if pose.heading.abs() > TURNED {
                return Err(PyValueError::new_err(format!(
                    "`poses`: the heading of {name} is {:.1} rad, beyond four revolutions; \
                     convert degrees with `np.radians`",
                    pose.heading
                )));
            }
        }
        Ok(self.task.scene.with_parts(poses))
    }

    /// Returns the task, with its robustness replaced if one is given.
    pub fn robust(&self, robustness: Option<f64>) -> Arc<Task> {
        match robustness {
            None => Arc::clone(&self.task),
            Some(share) => Arc::new(Task::clone(&self.task).robust(share)),
        }
    }
}
