//! Conversion of a task and its scene to the form of a file.

use crate::asset::diagnostic::{Fault, Faults};
use crate::asset::saved::emit;
use crate::{scene::Scene, task::Task};

impl Scene {
    /// Returns the scene as JSON with the keys of a task file's `scene`.
    pub fn to_json(&self) -> serde_json::Value {
        emit::scene(self)
    }
}

impl Task {
    /// Returns the task as JSON with the keys of its file, as written by [`Task::to_yaml`].
    pub fn to_json(&self) -> serde_json::Value {
        emit::task(self)
    }

    /// Returns the task as a YAML file that [`Task::parse`] reads back. The result is identical bit
    /// for bit if the angles came from a file or are round in degrees.
    ///
    /// # Errors
    /// Returns an error if the task holds a value that a file cannot represent.
    pub fn to_yaml(&self) -> Result<String, Faults> {
        serde_yaml::to_string(&emit::task(self)).map_err(|error| {
            let message = format!("the task cannot be written as YAML: {error}");
            Fault::of_file(&self.name, message, "check its numbers").into()
        })
    }
}
