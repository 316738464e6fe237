//! Trajectory files.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::asset::diagnostic::Faults;
use crate::asset::node::Node;
use crate::asset::read_text;
use crate::{
    outcome::{Contact, Frame, Trajectory},
    scene::{Body, Tool},
    task::{Plan, Task},
};

use super::read::{self, Opened};
use super::{PLAN_VERSION, TRAJECTORY_FILE, emit};

/// Executed or predicted motion of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryFile {
    /// Task whose scene moves.
    pub task: Task,
    /// Tools that moved, each once.
    pub tools: Vec<Arc<Tool>>,
    /// Steps of the plan.
    pub plan: Plan,
    /// Motion, with the model that computed it.
    pub trajectory: Trajectory,
}

impl TrajectoryFile {
    /// Reads a trajectory file.
    ///
    /// # Errors
    /// Returns all faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Parses the text of a trajectory file; `file` is its name in faults.
    ///
    /// # Errors
    /// Returns all faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        let mut opened = Opened::new(file, text, &TRAJECTORY_FILE)?;
        opened.ledger.sound()?;
        let own: Own = opened.typed()?;
        opened.check_plan(&own.plan);
        let node = opened.root.get("trajectory").cloned();
        let list = |key| node.as_ref().and_then(|node| node.get(key)).map(Node::items);
        check_frames(&mut opened, list("frames").unwrap_or_default(), &own);
        check_contacts(&mut opened, list("contacts").unwrap_or_default(), &own);
        let (tools, Own { plan, trajectory }) = (opened.tools, own);
        let file = opened.task.map(|task| Self { task, tools, plan, trajectory });
        opened.ledger.finish(file)
    }

    /// Writes the file; a partial file is never left behind.
    ///
    /// # Errors
    /// Returns an error if the path cannot be written, or the content could not be read back, for
    /// example because a number is not finite.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        read::write(path.as_ref(), self, Self::parse)
    }
}

fn check_frames(opened: &mut Opened, nodes: &[Node], own: &Own) {
    let frames: &[Frame] = &own.trajectory.frames;
    for (k, (node, frame)) in nodes.iter().zip(frames).enumerate() {
        opened.check_state(node.get("state"), &frame.state);
        if k > 0 && frame.time < frames[k - 1].time {
            let message =
                format!("frame {k} is at {} s, earlier than the frame before it", frame.time);
            opened.ledger.fault(node, message, "frames must be in order of time");
        }
        // The start belongs to step 0, even in a plan without steps.
        if frame.stroke >= own.plan.steps.len().max(1) {
            let steps = own.plan.steps.len();
            let message = format!("step {} does not exist: the plan has {steps}", frame.stroke + 1);
            opened.ledger.fault(node, message, "the file is damaged; create it again");
        }
    }
}

fn check_contacts(opened: &mut Opened, nodes: &[Node], own: &Own) {
    let Some(task) = &opened.task else { return };
    let parts = opened.tools.iter().map(|tool| tool.parts().len()).max().unwrap_or(0);
    let scene = &task.scene;
    for (node, contact) in nodes.iter().zip(&own.trajectory.contacts) {
        let Contact { frame, object, with } = *contact;
        let known = match with {
            Body::Object(index) => index < scene.objects.len(),
            Body::Obstacle(index) => index < scene.obstacles.len(),
            Body::Part(index) => index < parts,
        };
        if !known || object >= scene.objects.len() || frame >= own.trajectory.frames.len() {
            let message = "a contact refers to a body or frame that does not exist";
            opened.ledger.fault(node, message, "the file is damaged; create it again");
        }
    }
}

/// Keys deserialised with serde; the strict check has already read the others.
#[derive(Deserialize)]
struct Own {
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
            tools: Vec<serde_json::Value>,
            task: serde_json::Value,
            trajectory: &'a Trajectory,
        }
        Written {
            schema_version: PLAN_VERSION,
            kind: "trajectory",
            plan: &self.plan,
            tools: self.tools.iter().map(|tool| emit::tool(tool)).collect(),
            task: emit::task(&self.task),
            trajectory: &self.trajectory,
        }
        .serialize(serializer)
    }
}
