//! Plan files of levering, and what came of a lever-up.

use std::path::Path;
use std::sync::Arc;

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::asset::fault::{Fault, Faults, Place as At};
use crate::asset::lever::{blade_tool_of, lever_task_of};
use crate::asset::node::Node;
use crate::asset::read_text;
use crate::asset::spec::Value;
use crate::asset::strict::{Ledger, check};
use crate::asset::text::Source;
use crate::asset::tool::tool_of;
use crate::scene::{
    FollowUp, LEVER_FRAMES, LeverMotion, LeverOutcome, LeverPlan, LeverTrajectory, LeverVerdict,
    Plan, Plate, Task, Tool,
};

use super::emit;
use super::lever_spec::{LEVER_PLAN_FILE, LEVER_TRAJECTORY_FILE};
use super::{PlanFile, SCHEMA_VERSION, read};

/// A lever-up with everything that is needed to carry it out, and what is known of its effect.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverPlanFile {
    /// The task that it solves.
    pub task: Task,
    /// The tool that it uses.
    pub tool: Arc<Tool>,
    /// The lever-up.
    pub plan: LeverPlan,
    /// Name of the model that predicted the outcome.
    pub model: Option<String>,
    /// What that model says comes of it.
    pub predicted: Option<LeverOutcome>,
    /// Whether simulation confirms it.
    pub verdict: Option<LeverVerdict>,
}

/// What a plan file may be.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyPlanFile {
    /// A plan of pushes.
    Pushes(Box<PlanFile>),
    /// A lever-up.
    Levers(Box<LeverPlanFile>),
}

impl AnyPlanFile {
    /// Reads a plan file of either kind.
    ///
    /// # Errors
    /// All faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = read_text(path.as_ref())?;
        let kind = Node::parse(Source::json(&file, &text))?;
        match kind.get("kind").and_then(Node::text) {
            Some("lever_plan") => {
                LeverPlanFile::parse(&text, &file).map(|file| Self::Levers(Box::new(file)))
            }
            _ => PlanFile::parse(&text, &file).map(|file| Self::Pushes(Box::new(file))),
        }
    }
}

/// What happened when a lever-up was simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverTrajectoryFile {
    /// The task whose scene it is.
    pub task: Task,
    /// The tool that moved.
    pub tool: Arc<Tool>,
    /// The lever-up that it made.
    pub plan: LeverPlan,
    /// How the levered plate moved.
    pub trajectory: LeverTrajectory,
    /// Everything that moved, over time.
    pub motion: LeverMotion,
}

impl LeverPlanFile {
    /// Reads a plan file of levering.
    ///
    /// # Errors
    /// All faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Reads a plan file's text; `file` names it in faults.
    ///
    /// # Errors
    /// All faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        let (mut opened, own) = Opened::read::<OwnPlan>(file, text, &LEVER_PLAN_FILE)?;
        let follow_up = own.follow_up.and_then(|own| opened.follow_up(own.plan));
        let plan = LeverPlan { follow_up, ..own.plan };
        opened.finish(&plan, |task, tool| Self {
            task,
            tool,
            plan: plan.clone(),
            model: own.model.clone(),
            predicted: own.predicted.clone(),
            verdict: own.verdict.clone(),
        })
    }

    /// Writes the file; a partial one is never left behind.
    ///
    /// # Errors
    /// A path that cannot be written; contents that could not be read again.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        read::write(path.as_ref(), self, Self::parse)
    }
}

impl LeverTrajectoryFile {
    /// Reads a trajectory file of levering.
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
        let (mut opened, own) = Opened::read::<OwnTrajectory>(file, text, &LEVER_TRAJECTORY_FILE)?;
        let counts = [own.trajectory.lift.len(), own.trajectory.held.len()];
        if counts != [LEVER_FRAMES; 2] {
            let message = format!("a lever-up has {LEVER_FRAMES} frames");
            opened.damaged("trajectory", &message);
        }
        opened.finish(&own.plan, |task, tool| Self {
            task,
            tool,
            plan: own.plan.clone(),
            trajectory: own.trajectory.clone(),
            motion: own.motion.clone(),
        })
    }

    /// Writes the file; a partial one is never left behind.
    ///
    /// # Errors
    /// A path that cannot be written; contents that could not be read again.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        read::write(path.as_ref(), self, Self::parse)
    }
}

/// A file that has passed the strict check.
struct Opened<'a> {
    root: Node,
    ledger: Ledger<'a>,
    task: Option<Task>,
    tool: Option<Tool>,
}

impl<'a> Opened<'a> {
    /// Reads `text` as `value` tells, and what of it is the program's own types.
    fn read<T: for<'de> Deserialize<'de>>(
        file: &'a str,
        text: &'a str,
        value: &Value,
    ) -> Result<(Self, T), Faults> {
        let source = Source::json(file, text);
        let mut root = Node::parse(source)?;
        let mut ledger = Ledger::new(source);
        check(&mut root, value, &mut ledger);
        let task = root.get("task").and_then(|node| lever_task_of(node, file, &mut ledger));
        let tool = root.get("tool").and_then(|node| blade_tool_of(node, &mut ledger));
        ledger.sound()?;
        let own = serde_json::from_str(text).map_err(|error| {
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            Fault {
                file: file.into(),
                place: Some(At::in_json(text, error.line(), error.column())),
                message: message.into(),
                advice: "the file is damaged or of another version; make it again".into(),
            }
        })?;
        Ok((Self { root, ledger, task, tool }, own))
    }

    /// The pushes that follow, with the tool that the file holds for them.
    fn follow_up(&mut self, plan: Plan) -> Option<FollowUp> {
        let node = self.root.get("follow_up")?.get("tool")?.clone();
        let tool = Arc::new(tool_of(&node, &mut self.ledger)?);
        if tool.name != plan.tool {
            self.damaged("follow_up", "the pushes use another tool than the file holds for them");
        }
        Some(FollowUp { tool, plan })
    }

    fn damaged(&mut self, key: &str, message: &str) {
        let node = self.root.get(key).unwrap_or(&self.root);
        self.ledger.fault(node, message, "the file is damaged; make it again");
    }

    /// The file, if its plan is one of its task with its tool.
    fn finish<T>(
        mut self,
        plan: &LeverPlan,
        file: impl FnOnce(Task, Arc<Tool>) -> T,
    ) -> Result<T, Faults> {
        if let (Some(task), Some(tool)) = (&self.task, &self.tool) {
            let sides = task
                .scene
                .objects
                .get(plan.lever.plate)
                .map(|object| Plate::of(object).corners().len());
            let mixed = plan.tool != tool.name;
            if sides.is_none_or(|sides| plan.lever.place.edge >= sides) {
                self.damaged("plan", "the plan levers an edge that does not exist");
            } else if mixed {
                self.damaged("plan", "the plan uses another tool than the file holds");
            }
        }
        let whole = self.task.zip(self.tool);
        self.ledger.finish(whole.map(|(task, tool)| file(task, Arc::new(tool))))
    }
}

/// The keys that are the program's own types.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OwnPlan {
    #[serde(rename = "schema_version")]
    _schema_version: IgnoredAny,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "task")]
    _task: IgnoredAny,
    #[serde(rename = "tool")]
    _tool: IgnoredAny,
    plan: LeverPlan,
    follow_up: Option<OwnFollowUp>,
    model: Option<String>,
    predicted: Option<LeverOutcome>,
    verdict: Option<LeverVerdict>,
}

/// The keys that are the program's own types.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OwnFollowUp {
    #[serde(rename = "tool")]
    _tool: IgnoredAny,
    plan: Plan,
}

/// The keys that are the program's own types.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OwnTrajectory {
    #[serde(rename = "schema_version")]
    _schema_version: IgnoredAny,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "task")]
    _task: IgnoredAny,
    #[serde(rename = "tool")]
    _tool: IgnoredAny,
    plan: LeverPlan,
    trajectory: LeverTrajectory,
    motion: LeverMotion,
}

impl Serialize for LeverPlanFile {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a> {
            schema_version: u32,
            kind: &'static str,
            plan: &'a LeverPlan,
            #[serde(skip_serializing_if = "Option::is_none")]
            follow_up: Option<serde_json::Value>,
            model: &'a Option<String>,
            predicted: &'a Option<LeverOutcome>,
            verdict: &'a Option<LeverVerdict>,
            tool: serde_json::Value,
            task: serde_json::Value,
        }
        Written {
            schema_version: SCHEMA_VERSION,
            kind: "lever_plan",
            plan: &self.plan,
            follow_up: self.plan.follow_up.as_ref().map(|follow_up| {
                serde_json::json!({"tool": emit::tool(&follow_up.tool), "plan": follow_up.plan})
            }),
            model: &self.model,
            predicted: &self.predicted,
            verdict: &self.verdict,
            tool: emit::tool(&self.tool),
            task: emit::task(&self.task),
        }
        .serialize(serializer)
    }
}

impl Serialize for LeverTrajectoryFile {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a> {
            schema_version: u32,
            kind: &'static str,
            plan: &'a LeverPlan,
            tool: serde_json::Value,
            task: serde_json::Value,
            trajectory: &'a LeverTrajectory,
            motion: &'a LeverMotion,
        }
        Written {
            schema_version: SCHEMA_VERSION,
            kind: "lever_trajectory",
            plan: &self.plan,
            tool: emit::tool(&self.tool),
            task: emit::task(&self.task),
            trajectory: &self.trajectory,
            motion: &self.motion,
        }
        .serialize(serializer)
    }
}
