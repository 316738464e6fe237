//! Writing recordings, from what was read or from what was simulated.

use std::path::Path;
use std::sync::Arc;

use serde_json::{Value as Json, json};

use crate::asset::fault::{Fault, Faults};
use crate::asset::saved::{SCHEMA_VERSION, emit};
use crate::asset::write_atomic;
use crate::geometry::Pose;
use crate::scene::{COAST_FRAME, Frame, Scene, ToolMotion};

use super::load::{RecordedFrame, Recording};

impl Recording {
    /// What `frames` show of `motion` on `scene`, headings included: a simulation as if it had
    /// been recorded. The first frame must be the scene's start.
    pub fn of_frames(name: &str, scene: &Scene, motion: &ToolMotion, frames: &[Frame]) -> Self {
        let mut recorded: Vec<RecordedFrame> = Vec::new();
        let mut late = 0.0;
        for (k, frame) in frames.iter().enumerate() {
            let before = k.checked_sub(1).map(|before| &frames[before]);
            if let Some(before) = before.filter(|before| before.stroke != frame.stroke)
                && motion.strokes.get(before.stroke).is_some_and(|stroke| stroke.settle)
                && let Some(stroke) = motion.strokes.get(frame.stroke)
            {
                // Setting the tool down takes no time in a simulation; here it must take some.
                let time = before.time + late + COAST_FRAME;
                let poses = before.state.poses.clone();
                recorded.push(RecordedFrame { time, tool: stroke.from, lifted: true, poses });
                late += COAST_FRAME;
            }
            recorded.push(RecordedFrame {
                time: frame.time + late,
                tool: frame.tool,
                lifted: false,
                poses: frame.state.poses.clone(),
            });
        }
        Self {
            name: name.into(),
            description: String::new(),
            scene: scene.clone(),
            tool: Arc::clone(&motion.tool),
            lift: motion.lift,
            headings: vec![true; scene.objects.len()],
            frames: recorded,
        }
    }

    /// Writes the recording as JSON; a partial file is never left behind.
    ///
    /// # Errors
    /// A path that cannot be written; contents that could not be read again, such as numbers
    /// that are not finite.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = serde_json::to_string(&self.to_json()).map_err(|error| {
            Fault::of_file(&name, format!("cannot write it as JSON: {error}"), "")
        })?;
        // One frame a line: readable, and half as long as with one number a line.
        let text = text.replace("{\"objects\":", "\n{\"objects\":") + "\n";
        Self::parse(&text, &name)?;
        write_atomic(path, text.as_bytes())
    }

    fn to_json(&self) -> Json {
        let pose = |pose: &Pose, heading: bool| match heading {
            true => json!([pose.position.x, pose.position.y, emit::degrees(pose.heading)]),
            false => json!([pose.position.x, pose.position.y]),
        };
        let frames: Vec<Json> = self
            .frames
            .iter()
            .map(|frame| {
                let poses = frame.poses.iter().zip(&self.headings);
                let objects: Vec<Json> = poses.map(|(at, known)| pose(at, *known)).collect();
                let mut json = json!({"pusher": pose(&frame.tool, true), "objects": objects});
                if frame.lifted {
                    json["lifted"] = json!(true);
                }
                json
            })
            .collect();
        json!({
            "schema_version": SCHEMA_VERSION,
            "kind": "recording",
            "name": self.name,
            "description": self.description,
            "scene": emit::scene(&self.scene),
            "pusher": {"tool": emit::tool(&self.tool), "lift": self.lift},
            "times": self.frames.iter().map(|frame| frame.time).collect::<Vec<_>>(),
            "frames": frames,
        })
    }
}
