//! Record of a run: observations, beliefs and pushes.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::belief::Numbers;
use pushplan::asset::{Faults, write_atomic};
use pushplan::geometry::Pose;
use pushplan::{
    outcome::{Frame, Warning},
    scene::{State, TableFit, Tool},
    task::{Plan, Task, ToolMotion, Truth},
};

use super::error::ActError;
use super::gather::Note;
use super::judge::Chance;
use super::settings::RunSettings;
use super::world::{Look, Stop, WorldState};

/// Version of the trace format; runs of other versions cannot be resumed.
pub const TRACE_VERSION: u32 = 2;

/// Record of a run from its start to its current step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// Version of the trace format.
    pub schema_version: u32,
    /// Kind of file.
    pub kind: Kind,
    /// Task of the run.
    pub task: Task,
    /// Budgets and thresholds.
    pub settings: RunSettings,
    /// Planner: effect model and effort.
    pub planner: String,
    /// Ground truth of a simulated world. It is hidden from the planner.
    pub truth: Option<Truth>,
    /// Observation before the first push.
    pub first: Option<Look>,
    /// Corrections made to the first observation.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<Note>,
    /// State of the simulated world at the first observation.
    pub before: Option<WorldState>,
    /// Pairs of objects close enough to be joined at the first observation, if joints are unknown.
    pub pairs: Vec<[usize; 2]>,
    /// Initial joint probabilities of every pair, ordered as in [`Step::probabilities`].
    pub prior: Vec<[f64; 4]>,
    /// Initial belief about masses, frictions and supports.
    pub prior_numbers: Numbers,
    /// Steps in order.
    pub steps: Vec<Step>,
    /// Network fit learnt from all steps, including the initial fit; `None` if nothing was learnt.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub learnt: Option<TableFit>,
    /// Reason for the end of the run; `None` while it continues.
    pub end: Option<End>,
    /// Rule that the objects break according to the last observations, with [`End::RuleBroken`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub broken: Option<Warning>,
}

/// Kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Record of a run.
    Run,
}

/// Reason for a push.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Why {
    /// First push of a new plan that reaches the goal in enough samples.
    Plan,
    /// Next push of the previous plan, which still reaches the goal in enough samples.
    Rest,
    /// First push of the plan that is best on average; no plan reaches the goal in enough samples.
    Best,
    /// First push of an approach: the goals need more pushes than are planned at once.
    Approach,
    /// Exploratory push that separates samples relevant to the task.
    Probe,
}

/// Single push, or all pushes of a chained plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Reason for the push.
    pub why: Why,
    /// Plan from this step on.
    pub plan: Plan,
    /// Tool of the push.
    pub tool: Tool,
    /// Number of pushes of the plan that were carried out.
    pub pushes: usize,
    /// Expected outcome of the plan.
    pub chance: Chance,
    /// Expected pose of the goal's object after the pushes.
    pub expected: Pose,
    /// Predicted frames of the pushes under the most probable hypothesis.
    pub predicted: Vec<Frame>,
    /// Raw observations during the motion and at rest.
    pub looks: Vec<Look>,
    /// Additional observations at rest, if objects were missing.
    pub again: Vec<Look>,
    /// Point at which the robot stopped early, if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stop: Option<Stop>,
    /// Corrections made to the observations.
    pub notes: Vec<Note>,
    /// Estimated state after the step.
    pub state: State,
    /// Probabilities of no, a fixed, a revolute and a prismatic joint for each of [`Trace::pairs`].
    pub probabilities: Vec<[f64; 4]>,
    /// Belief about masses, frictions and supports.
    pub numbers: Numbers,
    /// State of the simulated world after the step.
    pub world: Option<WorldState>,
}

/// Reason for the end of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// The goal is reached according to the observations.
    Reached,
    /// The budget of pushes is exhausted.
    BudgetExhausted,
    /// No push brings the object nearer to the goal.
    NoImprovingPush,
    /// An object breaks a rule of the task according to the observations: see [`Trace::broken`].
    RuleBroken,
}

impl Step {
    /// Returns the executed motion, which ends early if the robot stopped.
    pub fn motion(&self) -> ToolMotion {
        let motion = self.plan.first(self.pushes).motion(&Arc::new(self.tool.clone()));
        match &self.stop {
            Some(stop) => stop.made(&motion),
            None => motion,
        }
    }
}

impl Trace {
    /// Creates the trace of a new run.
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
            broken: None,
        }
    }

    /// Ends the run if a rule is broken.
    pub(super) fn stop_at(&mut self, broken: Option<Warning>) {
        if broken.is_some() {
            self.end = Some(End::RuleBroken);
            self.broken = broken;
        }
    }

    /// Reads a trace.
    ///
    /// # Errors
    /// [`ActError::Trace`] if the file at `path` is missing or damaged.
    pub fn load(path: &Path) -> Result<Self, ActError> {
        let fault = |why: String| ActError::Trace(format!("{}: {why}", path.display()));
        let text = std::fs::read(path).map_err(|error| fault(error.to_string()))?;
        let trace: Self =
            serde_json::from_slice(&text).map_err(|error| fault(error.to_string()))?;
        // Pages count strokes by these indices.
        let strange = |step: &Step| step.predicted.iter().any(|frame| frame.stroke >= step.pushes);
        match trace.schema_version {
            TRACE_VERSION if trace.steps.iter().any(strange) => {
                Err(fault("a step predicts frames of pushes that it does not contain".to_owned()))
            }
            TRACE_VERSION => Ok(trace),
            other => Err(fault(format!(
                "the trace has version {other}, but this program resumes version {TRACE_VERSION} \
                 only; without --resume a new run begins"
            ))),
        }
    }

    /// Writes the trace atomically.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Faults> {
        // Serialising plain data cannot fail.
        let mut text = serde_json::to_vec(self).unwrap_or_default();
        text.push(b'\n');
        write_atomic(path, &text)
    }

    /// Returns `true` if both traces began equally, so that `self` can be resumed.
    pub fn is_of(&self, other: &Self) -> bool {
        self.task == other.task
            && self.settings == other.settings
            && self.planner == other.planner
            && self.truth == other.truth
    }

    /// Returns the notes on all corrections, in order.
    pub fn all_notes(&self) -> impl Iterator<Item = &Note> {
        self.notes.iter().chain(self.steps.iter().flat_map(|step| &step.notes))
    }

    /// Returns the number of pushes made so far, with every push of a chained plan counted.
    pub fn pushes(&self) -> usize {
        self.steps.iter().map(|step| step.pushes).sum()
    }

    /// Returns the true state in a simulated world.
    pub fn real(&self) -> Option<State> {
        let saved = match self.steps.last() {
            Some(step) => step.world.as_ref(),
            None => self.before.as_ref(),
        };
        saved.map(|saved| saved.state.clone())
    }
}
