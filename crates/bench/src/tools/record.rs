//! Benchmark record of a task.

use serde::{Deserialize, Serialize};

/// Method of choosing an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// No push.
    Nothing,
    /// Random sequence and stop.
    Random,
    /// Best of all sequences and stops, by execution in the 2-D engine.
    Oracle,
    /// First choice with the 2-D engine as effect model.
    Planar,
    /// First choice of the model among all sequences and stops.
    First,
    /// Planner: placed pushes, searched, refined and verified.
    Planned,
}

impl Method {
    /// Methods in the order of tables.
    pub const ALL: [Method; 6] = [
        Method::Nothing,
        Method::Random,
        Method::Oracle,
        Method::Planar,
        Method::First,
        Method::Planned,
    ];
}

/// Result of one execution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Executed {
    /// Distance from the goal, metres.
    pub error: f64,
    /// Whether the cylinder is at rest at its final position; otherwise the trial is no success.
    pub sound: bool,
}

/// Choice of one method for one task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolTrial {
    /// Method of the choice.
    pub method: Method,
    /// Prescribed tool pose; `None` for a free choice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<usize>,
    /// Chosen tool pose; `None` without a push.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub taken: Option<usize>,
    /// Predicted distance from the goal, metres; `None` without a prediction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub predicted: Option<f64>,
    /// Result in the 2-D engine.
    pub planar: Executed,
    /// Result in the 3-D engine.
    pub spatial: Executed,
    /// Number of pushes.
    pub pushes: usize,
    /// Travel of the tool, metres.
    pub travel: f64,
    /// Number of plans replayed by the planner until one passed or it gave up; `None` for methods
    /// without replays.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attempts: Option<usize>,
}

/// Record of one task: a start and a goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolRecord {
    /// Index of the start.
    pub start: usize,
    /// Position of the goal, metres.
    pub goal: [f64; 2],
    /// Trials of every method, for every tool pose alone and for all.
    pub trials: Vec<ToolTrial>,
}

impl ToolRecord {
    /// Methods whose time is recorded, with the key in the times of a task. The time covers
    /// the choice for a single task, without shared work.
    pub const TIMED: [(Method, &'static str); 2] =
        [(Method::First, "first"), (Method::Planned, "planned")];
}
