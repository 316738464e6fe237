//! A plan, and where it ends.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Goal, Push, PushForm, State, Tool, ToolMotion, Trajectory};

/// A physics engine of the simulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Engine {
    /// Top-down, with its own law of support friction: the default truth for data and search.
    Planar,
    /// Full 3-D: the independent check.
    Spatial,
    /// The 3-D engine in which nothing tips: the physics of the plane, solved by other code.
    Upright,
}

impl Engine {
    /// The engines of a verdict, in the order in which they are shown: predictions are compared
    /// with the planar one.
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
    /// Judges where a trajectory ended. One that did not come to rest, became NaN or infinite, or
    /// in which an object fell does not count as reaching the goal.
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
