//! What is kept of every task.

use serde::{Deserialize, Serialize};

/// A way of choosing what to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Not pushing.
    Nothing,
    /// A sequence and a stop at random.
    Random,
    /// The best of all sequences and stops, by trying them in the planar engine.
    Oracle,
    /// The first choice with the planar engine as effect model.
    Planar,
    /// The model's first choice among all sequences and stops.
    First,
    /// The planner: placed pushes, searched, refined and verified.
    Planned,
}

impl Method {
    /// All of them, in the order of tables.
    pub const ALL: [Method; 6] = [
        Method::Nothing,
        Method::Random,
        Method::Oracle,
        Method::Planar,
        Method::First,
        Method::Planned,
    ];
}

/// Where one execution ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Executed {
    /// Distance from the goal, metres.
    pub error: f64,
    /// Whether the cylinder is at rest where it is said to be; no success otherwise.
    pub sound: bool,
}

/// One choice for one task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolTrial {
    /// Who chose.
    pub method: Method,
    /// The tool pose that it had to take; `None` where it could choose among all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<usize>,
    /// The tool pose that was taken; `None` where it did not push.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub taken: Option<usize>,
    /// Predicted distance from the goal, metres; `None` without a prediction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub predicted: Option<f64>,
    /// In the planar engine.
    pub planar: Executed,
    /// In the 3-D engine.
    pub spatial: Executed,
    /// Number of pushes.
    pub pushes: usize,
    /// Travel of the tool, metres.
    pub travel: f64,
    /// Plans that the planner had replayed until one passed or it gave up; `None` for methods that
    /// try nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attempts: Option<usize>,
}

/// One task: a start and a goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolRecord {
    /// Index of the start.
    pub start: usize,
    /// Metres.
    pub goal: [f64; 2],
    /// Every method, for every tool pose alone and for all.
    pub trials: Vec<ToolTrial>,
}

impl ToolRecord {
    /// The methods whose wall time is kept, and its name among the times of a task: what
    /// choosing costs for a task by itself, nothing shared with others.
    pub const TIMED: [(Method, &'static str); 2] =
        [(Method::First, "first"), (Method::Planned, "planned")];
}
