//! Where a trajectory ends, judged by a goal.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose3, Vector};

use super::{Ending, Lift, Trajectory};
use crate::{
    scene::{Scene, State},
    task::{Goal, Task},
};

/// By how much a missed demand counts as missed once more: metres of an edge that is not yet high
/// enough, or of a centre that is still inside.
const STEP: f64 = 0.01;

/// Where a plan ends according to one source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Final poses of all objects.
    pub state: State,
    /// Distance of the first goal's object from its goal, metres.
    pub error: f64,
    /// Heading error, radians, where a heading is asked for.
    pub heading_error: Option<f64>,
    /// The same of the other goals, if there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<Miss>,
    /// Whether all goals are reached at rest.
    pub reached: bool,
    /// How the goal object lies, where something left the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lying: Option<Lying>,
}

/// How far an object ends from its goal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Miss {
    /// Index into [`Scene::objects`].
    pub object: usize,
    /// Distance from the goal, metres.
    pub error: f64,
    /// Heading error, radians, where a heading is asked for.
    pub heading_error: Option<f64>,
}

/// How an object lies in space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lying {
    /// The demand of the goal that is met worst: at most 1 if it is met.
    pub score: f64,
    /// How much higher its edge lay at the end of the last turn of a blade, metres.
    pub raised: f64,
    /// On which side it lies at rest.
    pub ending: Ending,
}

impl Outcome {
    /// Judges where a trajectory in `scene` ended by the goals of `task`. One that did not come to
    /// rest, became NaN or infinite, or in which an object fell does not count as reaching them.
    pub fn judge(scene: &Scene, task: &Task, trajectory: &Trajectory) -> Self {
        let goal = &task.goals[0];
        let state = trajectory.outcome().clone();
        let sound = trajectory.warnings.iter().all(|warning| !warning.forbids_success());
        let lying = Lying::of(scene, goal, trajectory);
        let mut near = lying.map_or_else(|| goal.reached(&state), |lying| lying.score <= 1.0);
        let further = task.goals.iter().skip(1).map(|goal| {
            near &= goal.reached(&state);
            let (error, heading_error) = (goal.error(&state), goal.heading_error(&state));
            Miss { object: goal.object, error, heading_error }
        });
        let further = further.collect();
        Self {
            error: goal.error(&state),
            heading_error: goal.heading_error(&state),
            further,
            reached: sound && state.is_finite() && near,
            lying,
            state,
        }
    }

    /// By what plans for a task are compared: at most 1 is success.
    pub fn score(&self, task: &Task) -> f64 {
        self.lying.map_or_else(|| task.score(&self.state), |lying| lying.score)
    }
}

impl Lying {
    /// How the goal's object lies at the end; nothing where all stayed in the plane, and nobody
    /// asks.
    fn of(scene: &Scene, goal: &Goal, trajectory: &Trajectory) -> Option<Self> {
        let state = trajectory.outcome();
        let rest = match &state.space {
            Some(poses) => *poses.get(goal.object)?,
            None if goal.in_space() => {
                Pose3::upright(*state.poses.get(goal.object)?, scene.objects.get(goal.object)?.z)
            }
            None => return None,
        };
        let lift = trajectory.lifts.iter().rev().find(|lift| lift.object == goal.object).copied();
        let ending = Ending::of(&rest);
        let demands = [
            goal.outside.map(|block| beyond(scene, block, rest.position.xy())),
            goal.raised.map(|wanted| raised(wanted, lift)),
            goal.flipped.map(|flipped| turned(flipped, ending, &rest)),
            goal.has_place().then(|| goal.error(state) / goal.tolerance),
            goal.heading.zip(goal.heading_error(state)).map(|((_, within), error)| error / within),
        ];
        // What has no number counts as far off; comparisons with it would count as met.
        let number = |score: f64| if score.is_finite() { score } else { f64::MAX };
        let score = demands.into_iter().flatten().map(number).fold(0.0, f64::max);
        Some(Self { score, raised: lift.map_or(0.0, |lift| lift.raised), ending })
    }
}

/// How well a centre lies outside of an obstacle.
fn beyond(scene: &Scene, obstacle: usize, centre: Vector) -> f64 {
    let Some(obstacle) = scene.obstacles.get(obstacle) else { return f64::MAX };
    let local = obstacle.pose.inverse().point(centre);
    let [x, y, _] = obstacle.size;
    let beyond = (local.x.abs() - 0.5 * x).max(local.y.abs() - 0.5 * y);
    1.0 - beyond / STEP
}

/// How well an edge was raised.
fn raised(wanted: f64, lift: Option<Lift>) -> f64 {
    let (found, held) = lift.map_or((0.0, false), |lift| (lift.raised, lift.held));
    let missing = (wanted - found) / STEP;
    if held { 1.0 + missing } else { 2.0 + missing.max(0.0) }
}

/// How well an object lies upside down, or on its underside.
fn turned(flipped: bool, ending: Ending, rest: &Pose3) -> f64 {
    let tilt = rest.tilt();
    let off = if flipped { PI - tilt } else { tilt };
    let wanted = if flipped { Ending::Flipped } else { Ending::Back };
    match ending == wanted {
        true => (off / FRAC_PI_2).min(1.0),
        false => 1.0 + off / FRAC_PI_2,
    }
}
