//! Writing of recordings.

use std::path::Path;

use serde_json::{Value as Json, json};

use crate::asset::diagnostic::{Fault, Faults};
use crate::asset::saved::{SCHEMA_VERSION, emit};
use crate::asset::write_atomic;
use crate::geometry::Pose;
use crate::recording::Recording;
use crate::scene::Velocity;

impl Recording {
    /// Writes the recording as JSON; a partial file is never left behind.
    ///
    /// # Errors
    /// Returns an error if the path cannot be written, or the content could not be read back, for
    /// example because a number is not finite.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = serde_json::to_string(&self.to_json()).map_err(|error| {
            Fault::of_file(&name, format!("cannot write it as JSON: {error}"), "")
        })?;
        // One frame per line is readable, and half as long as one number per line.
        let text = text.replace("{\"objects\":", "\n{\"objects\":");
        let text = text.replace("{\"pusher\":[", "\n{\"pusher\":[") + "\n";
        Self::parse(&text, &name)?;
        write_atomic(path, text.as_bytes())
    }

    /// Returns the recording as JSON with the keys of its file.
    pub fn to_json(&self) -> Json {
        let pose = |pose: &Pose, heading: bool| match heading {
            true => {
                json!([pose.position.x, pose.position.y, crate::asset::put::degrees(pose.heading)])
            }
            false => json!([pose.position.x, pose.position.y]),
        };
        let frames: Vec<Json> = self
            .frames
            .iter()
            .map(|frame| {
                let poses = frame.poses.iter().zip(&self.headings);
                let objects: Vec<Json> = poses.map(|(at, known)| pose(at, *known)).collect();
                let mut json = json!({"pusher": pose(&frame.tool, true)});
                if frame.seen {
                    json["objects"] = json!(objects);
                }
                if frame.lifted {
                    json["lifted"] = json!(true);
                }
                json
            })
            .collect();
        let mut scene = emit::scene(&self.scene);
        let objects = scene["objects"].as_array_mut().into_iter().flatten();
        for (object, Velocity { linear, angular }) in objects.zip(&self.velocities) {
            if linear.norm() > 0.0 {
                object["velocity"] = json!([linear.x, linear.y]);
            }
            if *angular != 0.0 {
                object["spin_deg"] = json!(angular.to_degrees());
            }
        }
        json!({
            "schema_version": SCHEMA_VERSION,
            "kind": "recording",
            "name": self.name,
            "description": self.description,
            "scene": scene,
            "pusher": {"tool": emit::tool(&self.tool), "lift": self.lift},
            "times": self.frames.iter().map(|frame| frame.time).collect::<Vec<_>>(),
            "frames": frames,
        })
    }
}
