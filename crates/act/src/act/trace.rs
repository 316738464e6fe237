//! What happened in a run: all that was seen, thought and done.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::belief::Numbers;
use pushplan::asset::{Faults, write_atomic};
use pushplan::geometry::Pose;
use pushplan::{
    outcome::Frame,
    scene::{State, TableFit, Tool},
    task::{Plan, Task, ToolMotion, Truth},
};

use super::error::ActError;
use super::gather::Note;
use super::judge::Chance;
use super::settings::RunSettings;
use super::world::{Look, Stop, WorldState};

/// Version of the format; runs of another one cannot be continued.
pub const TRACE_VERSION: u32 = 2;

/// A run from its beginning to where it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// Version of the format.
    pub schema_version: u32,
    /// What the file is.
    pub kind: Kind,
    /// What is to be done.
    pub task: Task,
    /// With which budgets.
    pub settings: RunSettings,
    /// What plans: effect model and effort.
    pub planner: String,
    /// What the world is really like, where it is simulated. The planner does not see it.
    pub truth: Option<Truth>,
    /// What was seen before anything was done.
    pub first: Option<Look>,
    /// What was odd about that.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<Note>,
    /// The simulated world then.
    pub before: Option<WorldState>,
    /// Pairs of objects that were seen near each other then and so may be joined, where that is unknown.
    pub pairs: Vec<[usize; 2]>,
    /// What was believed then of every one of them, as in steps.
    pub prior: Vec<[f64; 4]>,
    /// What was believed then of masses, frictions and supports.
    pub prior_numbers: Numbers,
    /// What was done, in order.
    pub steps: Vec<Step>,
    /// What all of that taught the network, with what it had been given; `None` if nothing was learnt.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub learnt: Option<TableFit>,
    /// How it ended; `None` as long as it goes on.
    pub end: Option<End>,
}

/// What the file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A run.
    Run,
}

/// Why a push was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Why {
    /// It begins a new plan that reaches the goal in enough samples.
    Plan,
    /// It goes on with the plan before, which still does.
    Rest,
    /// No plan reaches the goal in enough samples; it begins the one that is best on average.
    Best,
    /// It is the first of a way to the goals that takes more pushes than are planned at once.
    Approach,
    /// It tells apart what the task depends on.
    Probe,
}

/// One push, or the pushes of a chained plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Why it was made.
    pub why: Why,
    /// The plan from here on.
    pub plan: Plan,
    /// With which tool.
    pub tool: Tool,
    /// How many of its pushes were made.
    pub pushes: usize,
    /// What was expected of the plan.
    pub chance: Chance,
    /// Where the goal's object was expected after these pushes.
    pub expected: Pose,
    /// What was expected of these pushes, frame by frame, under what was likeliest then.
    pub predicted: Vec<Frame>,
    /// What was seen meanwhile and at rest, as it was reported.
    pub looks: Vec<Look>,
    /// What was seen at rest where that was not enough, look by look.
    pub again: Vec<Look>,
    /// Where the robot could not go on, if it could not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stop: Option<Stop>,
    /// What was wrong with all that.
    pub notes: Vec<Note>,
    /// Where everything is thought to be now.
    pub state: State,
    /// Of each of [`Trace::pairs`] the probabilities of no, a fixed, a revolute and a prismatic joint.
    pub probabilities: Vec<[f64; 4]>,
    /// What is believed of masses, frictions and supports.
    pub numbers: Numbers,
    /// The simulated world after it.
    pub world: Option<WorldState>,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// The goal is reached, as far as can be seen.
    Reached,
    /// All pushes are used up.
    UsedUp,
    /// No push brings the object nearer.
    NoPush,
}

impl Step {
    /// The motion of the pushes that were made, as far as it was.
    pub fn motion(&self) -> ToolMotion {
        let motion = self.plan.first(self.pushes).motion(&Arc::new(self.tool.clone()));
        match &self.stop {
            Some(stop) => stop.made(&motion),
            None => motion,
        }
    }
}

impl Trace {
    /// Of a run that begins.
    pub fn new(task: Task, settings: RunSettings, planner: String, truth: Option<Truth>) -> Self {
        Self {
            schema_version: TRACE_VERSION,
            kind: Kind::Run,
            task,
            settings,
            planner,
            truth,
            first: None,
            notes: Vec::new(),
            before: None,
            pairs: Vec::new(),
            prior: Vec::new(),
            prior_numbers: Numbers::default(),
            steps: Vec::new(),
            learnt: None,
            end: None,
        }
    }

    /// Reads a trace.
    ///
    /// # Errors
    /// [`ActError::Trace`] if there is none at `path`, or a damaged one.
    pub fn load(path: &Path) -> Result<Self, ActError> {
        let fault = |why: String| ActError::Trace(format!("{}: {why}", path.display()));
        let text = std::fs::read(path).map_err(|error| fault(error.to_string()))?;
        let trace: Self =
            serde_json::from_slice(&text).map_err(|error| fault(error.to_string()))?;
        // Strokes are counted when a page is made of them.
        let strange = |step: &Step| step.predicted.iter().any(|frame| frame.stroke >= step.pushes);
        match trace.schema_version {
            TRACE_VERSION if trace.steps.iter().any(strange) => {
                Err(fault("a step predicts frames of pushes that it does not make".to_owned()))
            }
            TRACE_VERSION => Ok(trace),
            other => Err(fault(format!(
                "it is of version {other}, this program goes on with {TRACE_VERSION} alone; without \
                 --resume a new run begins"
            ))),
        }
    }

    /// Writes the trace whole or not at all.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Faults> {
        // Plain data: it always has a JSON text.
        let mut text = serde_json::to_vec(self).unwrap_or_default();
        text.push(b'\n');
        write_atomic(path, &text)
    }

    /// Whether it began as `other` did, so that it can be gone on with.
    pub fn is_of(&self, other: &Self) -> bool {
        self.task == other.task
            && self.settings == other.settings
            && self.planner == other.planner
            && self.truth == other.truth
    }

    /// All that was odd about what was seen, in order.
    pub fn all_notes(&self) -> impl Iterator<Item = &Note> {
        self.notes.iter().chain(self.steps.iter().flat_map(|step| &step.notes))
    }

    /// Pushes made so far, those of chained plans one by one.
    pub fn pushes(&self) -> usize {
        self.steps.iter().map(|step| step.pushes).sum()
    }

    /// Where everything really is in a simulated world.
    pub fn real(&self) -> Option<State> {
        let saved = match self.steps.last() {
            Some(step) => step.world.as_ref(),
            None => self.before.as_ref(),
        };
        saved.map(|saved| saved.state.clone())
    }
}
