//! A plan and the evidence that it works.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Goal, Push, PushForm, State, Tool, ToolMotion, Trajectory, Warning};

/// A physics engine of the simulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// Top-down, with a support-friction law of our own: the default truth for data and search.
    Planar,
    /// Full 3-D: the independent check.
    Spatial,
}

impl Engine {
    /// Both, in the order in which they are shown: predictions are compared with the planar one.
    pub const ALL: [Self; 2] = [Self::Planar, Self::Spatial];
}

/// A tool, how it is held, and the pushes to make with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Name of the tool.
    pub tool: String,
    /// Turn of the end effector about z against world +x, radians.
    pub grip_yaw: f64,
    /// How the pushes start.
    pub form: PushForm,
    /// Height of the tool's underside above the table, metres.
    pub lift: f64,
    /// In order.
    pub pushes: Vec<Push>,
}

impl Plan {
    /// What the tool does when the plan is carried out with `tool`, the one it names.
    pub fn motion(&self, tool: &Arc<Tool>) -> ToolMotion {
        let placed = self.form == PushForm::Placed;
        ToolMotion::pushes(Arc::clone(tool), self.lift, self.grip_yaw, &self.pushes, placed)
    }
}

/// Where a plan ends according to one source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Final poses of all objects.
    pub state: State,
    /// Distance of the goal object from the goal, metres.
    pub error: f64,
    /// Heading error, radians, where a heading is asked for.
    pub heading_error: Option<f64>,
    /// Whether the goal is reached at rest.
    pub reached: bool,
}

impl Outcome {
    /// Judges where a trajectory ended. One that did not come to rest, left the finite numbers,
    /// or lost an object's footing does not count as reaching the goal.
    pub fn judge(goal: &Goal, trajectory: &Trajectory) -> Self {
        let state = trajectory.outcome().clone();
        let sound = trajectory.warnings.iter().all(|warning| !warning.forbids_success());
        Self {
            error: goal.error(&state),
            heading_error: goal.heading_error(&state),
            reached: sound && state.is_finite() && goal.reached(&state),
            state,
        }
    }
}

/// What a replay changes against the task as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Disturbance {
    /// Nothing.
    Nominal,
    /// Where objects start and every friction value, by little and at random.
    Disturbed {
        /// Number of the draw, from 1; the same for the same seed in both engines.
        draw: usize,
    },
}

/// One replay of a plan in an engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// Which engine.
    pub engine: Engine,
    /// What was changed against the task as written.
    pub disturbance: Disturbance,
    /// Where it ended.
    pub outcome: Outcome,
    /// What happened on the way that a reader should know.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Warning>,
    /// What happened frame by frame, of a nominal replay. Not written to files: replaying the
    /// plan brings it back.
    #[serde(skip)]
    pub trajectory: Option<Trajectory>,
}

/// Whether a plan works, with what shows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Passed: the nominal replay in the 3-D engine reaches the goal at rest.
    pub passed: bool,
    /// All replays, nominal ones first.
    pub evidence: Vec<Evidence>,
    /// Share of the disturbed 3-D replays that reach the goal, 0 to 1; `None` if none was made.
    pub robustness: Option<f64>,
}

impl Verdict {
    /// The replay as written in an engine.
    pub fn nominal(&self, engine: Engine) -> Option<&Evidence> {
        self.of(engine).find(|evidence| evidence.disturbance == Disturbance::Nominal)
    }

    /// The disturbed replays in an engine, in the order of their draws.
    pub fn disturbed(&self, engine: Engine) -> impl Iterator<Item = &Evidence> {
        self.of(engine).filter(|evidence| evidence.disturbance != Disturbance::Nominal)
    }

    fn of(&self, engine: Engine) -> impl Iterator<Item = &Evidence> {
        self.evidence.iter().filter(move |evidence| evidence.engine == engine)
    }
}
