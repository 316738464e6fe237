//! A task back as a file, and its scene.

use crate::asset::fault::{Fault, Faults};
use crate::asset::saved::emit;
use crate::{scene::Scene, task::Task};

impl Scene {
    /// The scene in the keys of a task file's `scene`.
    pub fn to_json(&self) -> serde_json::Value {
        emit::scene(self)
    }
}

impl Task {
    /// The task in the keys of its file: what [`Task::to_yaml`] writes.
    pub fn to_json(&self) -> serde_json::Value {
        emit::task(self)
    }

    /// The task as a YAML file that [`Task::parse`] reads back. It is the same task to the bit if
    /// its angles came from a file or are round in degrees.
    ///
    /// # Errors
    /// If the task holds what no file can.
    pub fn to_yaml(&self) -> Result<String, Faults> {
        serde_yaml::to_string(&emit::task(self)).map_err(|error| {
            let message = format!("the task cannot be written as YAML: {error}");
            Fault::of_file(&self.name, message, "check its numbers").into()
        })
    }
}
