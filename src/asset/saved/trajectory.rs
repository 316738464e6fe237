//! Trajectory files.

use std::path::Path;
use std::sync::Arc;

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::asset::fault::Faults;
use crate::asset::node::Node;
use crate::asset::read_text;
use crate::scene::{Body, Contact, Frame, Plan, Task, Tool, Trajectory};

use super::read::{self, Opened};
use super::{SCHEMA_VERSION, TRAJECTORY_FILE, emit};

/// What happened, or was predicted to happen, when a plan was carried out.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryFile {
    /// The task whose scene it is.
    pub task: Task,
    /// The tool that moved.
    pub tool: Arc<Tool>,
    /// The pushes that it made.
    pub plan: Plan,
    /// The motion, and which model computed it.
    pub trajectory: Trajectory,
}

impl TrajectoryFile {
    /// Reads a trajectory file.
    ///
    /// # Errors
    /// All faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Reads a trajectory file's text; `file` names it in faults.
    ///
    /// # Errors
    /// All faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        let mut opened = Opened::new(file, text, &TRAJECTORY_FILE)?;
        opened.ledger.sound()?;
        let own: Own = opened.typed()?;
        opened.check_plan(&own.plan);
        let node = opened.root.get("trajectory").cloned();
        let list = |key| node.as_ref().and_then(|node| node.get(key)).map(Node::items);
        check_frames(&mut opened, list("frames").unwrap_or_default(), &own);
        check_contacts(&mut opened, list("contacts").unwrap_or_default(), &own);
        let file = match (opened.task, opened.tool) {
            (Some(task), Some(tool)) => {
                Some(Self { task, tool, plan: own.plan, trajectory: own.trajectory })
            }
            _ => None,
        };
        opened.ledger.finish(file)
    }

    /// Writes the file; a partial one is never left behind.
    ///
    /// # Errors
    /// A path that cannot be written; contents that could not be read again, such as numbers
    /// that are not finite.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        read::write(path.as_ref(), self, Self::parse)
    }
}

fn check_frames(opened: &mut Opened, nodes: &[Node], own: &Own) {
    let frames: &[Frame] = &own.trajectory.frames;
    for (k, (node, frame)) in nodes.iter().zip(frames).enumerate() {
        opened.check_state(node.get("state"), &frame.state);
        if k > 0 && frame.time < frames[k - 1].time {
            let message = format!("frame {k} is at {} s, before the one before it", frame.time);
            opened.ledger.fault(node, message, "frames are in order of time");
        }
        // The start belongs to push 0, also where there is none.
        if frame.stroke >= own.plan.pushes.len().max(1) {
            let pushes = own.plan.pushes.len();
            let message = format!("push {} of a plan with {pushes}", frame.stroke + 1);
            opened.ledger.fault(node, message, "the file is damaged; make it again");
        }
    }
}

fn check_contacts(opened: &mut Opened, nodes: &[Node], own: &Own) {
    let (Some(task), Some(tool)) = (&opened.task, &opened.tool) else { return };
    let scene = &task.scene;
    for (node, contact) in nodes.iter().zip(&own.trajectory.contacts) {
        let Contact { frame, object, with } = *contact;
        let known = match with {
            Body::Object(index) => index < scene.objects.len(),
            Body::Obstacle(index) => index < scene.obstacles.len(),
            Body::Part(index) => index < tool.outline().len(),
        };
        if !known || object >= scene.objects.len() || frame >= own.trajectory.frames.len() {
            let message = "a contact with a body or in a frame that does not exist";
            opened.ledger.fault(node, message, "the file is damaged; make it again");
        }
    }
}

/// The keys that are the program's own types.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Own {
    #[serde(rename = "schema_version")]
    _schema_version: IgnoredAny,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "task")]
    _task: IgnoredAny,
    #[serde(rename = "tool")]
    _tool: IgnoredAny,
    plan: Plan,
    trajectory: Trajectory,
}

impl Serialize for TrajectoryFile {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a> {
            schema_version: u32,
            kind: &'static str,
            plan: &'a Plan,
            tool: serde_json::Value,
            task: serde_json::Value,
            trajectory: &'a Trajectory,
        }
        Written {
            schema_version: SCHEMA_VERSION,
            kind: "trajectory",
            plan: &self.plan,
            tool: emit::tool(&self.tool),
            task: emit::task(&self.task),
            trajectory: &self.trajectory,
        }
        .serialize(serializer)
    }
}
