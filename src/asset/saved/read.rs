//! Common parts of reading plan and trajectory files: the strict check, the task and the tools.

use std::path::Path;
use std::sync::Arc;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::asset::diagnostic::{Fault, Faults, Place};
use crate::asset::node::Node;
use crate::asset::spec::Value;
use crate::asset::strict::{Ledger, check};
use crate::asset::text::Source;
use crate::asset::{task, tool, write_atomic};
use crate::{
    outcome::Outcome,
    scene::{JointTrajectory, State, Tool},
    task::{Plan, Step, Task},
};

/// File that has passed the strict check, open for the rules that span several keys.
pub(super) struct Opened<'a> {
    pub source: Source<'a>,
    pub root: Node,
    pub ledger: Ledger<'a>,
    pub task: Option<Task>,
    pub tools: Vec<Arc<Tool>>,
}

impl<'a> Opened<'a> {
    /// Parses `text` according to the specification `value`.
    ///
    /// # Errors
    /// Returns one fault if the text is not JSON; all other faults are in the ledger.
    pub fn new(file: &'a str, text: &'a str, value: &Value) -> Result<Self, Faults> {
        let source = Source::json(file, text);
        let mut root = Node::parse(source)?;
        let mut ledger = Ledger::new(source);
        check(&mut root, value, &mut ledger);
        let task = root.get("task").and_then(|node| task::task_of(node, file, &mut ledger));
        let mut tools: Vec<Arc<Tool>> = Vec::new();
        for node in root.get("tools").map(Node::items).unwrap_or_default() {
            let Some(tool) = tool::tool_of(node, &mut ledger) else { continue };
            if !tools.iter().any(|known| known.name == tool.name) {
                tools.push(Arc::new(tool));
            }
        }
        Ok(Self { source, root, ledger, task, tools })
    }

    /// Deserialises the parts of the file that are types of the program.
    pub fn typed<T: DeserializeOwned>(&self) -> Result<T, Fault> {
        serde_json::from_str(self.source.text).map_err(|error| {
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            Fault {
                file: self.source.file.into(),
                place: Some(Place::in_json(self.source.text, error.line(), error.column())),
                message: message.into(),
                advice: "the file is damaged or from another version; create it again".into(),
            }
        })
    }

    /// Checks that the joint trajectory belongs to the task's arm.
    pub fn check_joints(&mut self, joints: Option<&JointTrajectory>) {
        let (Some(joints), Some(node)) = (joints, self.root.get("joints")) else { return };
        let again = "the file is damaged; create it again";
        if let Some(fault) = joints.fault() {
            self.ledger.fault(node, fault, again);
        }
        let arm = self.task.as_ref().map(|task| task.arm.as_deref());
        if arm == Some(None) {
            self.ledger.fault(
                node,
                "the file contains joint motion, but its task has no arm",
                again,
            );
        }
    }

    /// Checks that the plan is valid for this task and these tools.
    pub fn check_plan(&mut self, plan: &Plan) {
        let Some(node) = self.root.get("plan") else { return };
        let tools: Vec<&str> = self.tools.iter().map(|tool| tool.name.as_str()).collect();
        let mixed = "the file mixes two plans; create it again";
        if let Some(tool) = plan.tools().into_iter().find(|tool| !tools.contains(tool)) {
            let message =
                format!("the plan uses `{tool}`, the file holds `{}`", tools.join("`, `"));
            self.ledger.fault(node, message, mixed);
        }
        for step in &plan.steps {
            let Some(tool) = self.tools.iter().find(|tool| tool.name == step.tool()) else {
                continue;
            };
            let (able, what) = match step {
                Step::Push(_) => (tool.pushes(), "has a blade, so it cannot push"),
                Step::LeverUp(_) => (tool.blade().is_some(), "has no blade, so it cannot lever"),
            };
            if !able {
                self.ledger.fault(node, format!("`{}` {what}", tool.name), mixed);
            }
            let arm = self.task.as_ref().and_then(|task| task.arm.as_deref());
            if let Some((message, _)) = arm.and_then(|arm| arm.refuses(tool)) {
                self.ledger.fault(node, message, "mount the tool farther below, and plan again");
            }
        }
        let Some(task) = &self.task else { return };
        for lever in plan.lever_steps().map(|step| &step.lever) {
            if lever.place.edge >= task.scene.edges(lever.plate) {
                let message = "the plan levers an edge that does not exist";
                self.ledger.fault(node, message, "the file is damaged; create it again");
            }
        }
    }

    /// Checks that an outcome belongs to this task's scene.
    pub fn check_outcome(&mut self, node: Option<&Node>, outcome: &Outcome) {
        self.check_state(node.and_then(|node| node.get("state")), &outcome.state);
        let (Some(node), Some(task)) = (node, &self.task) else { return };
        let wanted: Vec<usize> = task.goals.iter().map(|goal| goal.object).collect();
        let found: Vec<usize> = outcome.goals.iter().map(|miss| miss.object).collect();
        if wanted != found {
            let message = format!("expected ends of objects {wanted:?}, found {found:?}");
            self.ledger.fault(node, message, "the file is damaged; create it again");
        }
    }

    /// Checks that a state has every object of the scene.
    pub fn check_state(&mut self, node: Option<&Node>, state: &State) {
        let (Some(node), Some(task)) = (node, &self.task) else { return };
        // A compound object that has left the plane has one pose for all its solids.
        let (solids, things) = (task.scene.objects.len(), task.scene.things().count());
        let space = state.space.as_ref().map_or(things, Vec::len);
        for (what, found, expected) in [
            ("poses", state.poses.len(), solids),
            ("velocities", state.velocities.len(), solids),
            ("3-D poses", space, things),
        ] {
            if found != expected {
                let message = format!("expected {expected} {what}, one per object, found {found}");
                self.ledger.fault(node, message, "the file is damaged; create it again");
            }
        }
    }
}

/// Writes `file` as JSON to `path` after reading it back with `read`, so that every written file is
/// readable.
pub(super) fn write<T>(
    path: &Path,
    file: &impl Serialize,
    read: impl Fn(&str, &str) -> Result<T, Faults>,
) -> Result<(), Faults> {
    let name = path.display().to_string();
    let mut text = serde_json::to_string_pretty(file)
        .map_err(|error| Fault::of_file(&name, format!("cannot write it as JSON: {error}"), ""))?;
    text.push('\n');
    read(&text, &name)?;
    write_atomic(path, text.as_bytes())
}
