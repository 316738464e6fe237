//! States between legs, and the task of one leg.

use crate::geometry::{Footprint, Vector};
use crate::{
    scene::{Situation, State},
    task::{Directions, Goal, PushRules, Task},
};

use super::legs::Leg;

/// Tolerance of an object's position at the end of a leg, metres. An object further off would not
/// pass the next gap.
const NEAR: f64 = 0.01;

/// Tolerance of an object's heading at the end of a leg relative to the start, radians.
const TURNED: f64 = 0.1;

/// Score above which a leg is lost, so that the next legs do not start.
pub(super) const LOST: f64 = 1.5;

/// Length of a push beyond its leg, metres, because the tool starts farther away.
const LONGER: f64 = 0.05;

/// State between two legs.
#[derive(Clone)]
pub(super) struct Station {
    pub state: State,
    /// States for other plausible physics.
    pub others: Vec<State>,
    /// Number of pushes so far.
    pub pushes: usize,
    /// Position of the end effector.
    pub tool: Vector,
}

/// Reason for which a leg is lost.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Lost {
    /// No push is feasible.
    Infeasible,
    /// Every push ends elsewhere.
    Off,
}

/// Returns the task of carrying one object to the end of a leg.
pub(super) fn towards(task: &Task, leg: &Leg, now: &Situation, grip_yaw: f64) -> Task {
    let object = &task.scene.objects[leg.object];
    let own = task.goals.iter().find(|goal| leg.last && goal.object == leg.object);
    let tolerance = own.map_or(NEAR, |goal| goal.tolerance().min(NEAR));
    let goal = Goal::new(leg.object, [leg.to.x, leg.to.y], tolerance);
    let turns = !matches!(object.shape.footprint(), Footprint::Disc { .. });
    let goal = match turns {
        true => goal.facing(now.start.poses[leg.object].heading, TURNED),
        false => goal,
    };
    let pushes = PushRules {
        directions: Directions::List(vec![leg.direction]),
        grip_yaws: vec![grip_yaw],
        length: (leg.to - leg.from).norm() + LONGER,
        max_count: 1,
        ..task.pushes.clone()
    };
    Task { goals: vec![goal], pushes, ..task.clone() }
}
