//! A plan and the evidence that it works.

use serde::{Deserialize, Serialize};

use super::{Push, PushForm, State};

/// A physics engine of the simulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// Top-down, with a support-friction law of our own: the default truth for data and search.
    Planar,
    /// Full 3-D: the independent check.
    Spatial,
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

/// One replay of a plan in an engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// Which engine.
    pub engine: Engine,
    /// What was changed against the task as written; `nominal` for nothing.
    pub disturbance: String,
    /// Where it ended.
    pub outcome: Outcome,
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
