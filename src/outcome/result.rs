//! Final state of a trajectory, judged by all demands of all goals.

use serde::{Deserialize, Serialize};

use super::Trajectory;
use crate::{
    scene::{Scene, State},
    task::{End, Ending, Goal, Lift, Task},
};

/// Final state of a plan according to one source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Final poses of all objects.
    pub state: State,
    /// Errors of the goals, in the order of the task.
    pub goals: Vec<Miss>,
    /// Whether all goals are reached at rest.
    pub reached: bool,
}

/// Error of one goal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Miss {
    /// Index into [`Scene::objects`].
    pub object: usize,
    /// Distance from the goal, metres.
    pub error: f64,
    /// Heading error, radians, if the goal has a heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading_error: Option<f64>,
    /// Largest error among the goal's demands in units of their tolerances: at most 1 if all are
    /// met.
    pub score: f64,
    /// Height to which a blade had lifted an edge of the object at the end of its last rotation,
    /// metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub raised: Option<f64>,
}

impl Miss {
    /// Returns the error of a goal in the final state.
    fn of(goal: &Goal, state: &State, lift: Option<Lift>) -> Self {
        // A NaN score becomes the largest number, because comparisons with NaN would count as met.
        let score = Some(goal.score_after(state, lift)).filter(|score| score.is_finite());
        Self {
            object: goal.object,
            error: goal.error(state),
            heading_error: goal.heading_error(state),
            score: score.unwrap_or(f64::MAX),
            raised: lift.map(|lift| lift.raised),
        }
    }
}

impl Outcome {
    /// Judges the end of a trajectory in `scene` by the goals of `task`. The goals count as missed
    /// if the trajectory did not end at rest, became NaN or infinite, or an object fell.
    pub fn judge(scene: &Scene, task: &Task, trajectory: &Trajectory) -> Self {
        let sound = trajectory.warnings.iter().all(|warning| !warning.forbids_success());
        Self::of_state((scene, task), trajectory.outcome().clone(), &trajectory.lifts, sound)
    }

    /// Judges a state after these lifts. `sound` states that no fault occurred on the way.
    pub fn of_state(
        (scene, task): (&Scene, &Task),
        state: State,
        lifts: &[Lift],
        sound: bool,
    ) -> Self {
        let lift = |goal: &Goal| {
            let mut lifts = lifts.iter().rev();
            lifts.find(|lift| lift.object == goal.object).copied()
        };
        let known = |goal: &&Goal| goal.object < state.poses.len().min(scene.objects.len());
        let near = task.goals.iter().all(|goal| known(&goal) && goal.is_met(&state, lift(goal)));
        let goals = task.goals.iter().filter(known);
        let goals = goals.map(|goal| Miss::of(goal, &state, lift(goal))).collect();
        Self { goals, reached: sound && state.is_finite() && near, state }
    }

    /// Returns the worst score of all goals, by which plans are compared: at most 1 is success.
    pub fn score(&self) -> f64 {
        self.goals.iter().map(|goal| goal.score).fold(0.0, f64::max)
    }

    /// Returns the largest distance from a goal, metres.
    pub fn error(&self) -> f64 {
        self.goals.iter().map(|goal| goal.error).reduce(f64::max).unwrap_or(0.0)
    }

    /// Returns the largest heading error, radians, if any goal has a heading.
    pub fn heading_error(&self) -> Option<f64> {
        self.goals.iter().filter_map(|goal| goal.heading_error).reduce(f64::max)
    }

    /// Returns the side on which an object lies.
    pub fn side(&self, object: usize) -> Ending {
        End::resting(object, &self.state).side().1
    }
}
