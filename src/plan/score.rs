//! How good a rollout is: the error in units of the tolerance, and which ones come after all
//! others.

use crate::{
    outcome::{Trajectory, Warning},
    scene::State,
    task::Task,
};

/// Added to the score of a rollout that leads through something that a rigid body cannot pass. More
/// than any error in units of a tolerance, so such a candidate is tried only when there is no
/// other: it is not refused, because a prediction of a few millimetres too much proves nothing.
const BEHIND: f64 = 1e6;

/// Score of a finished rollout: error in units of the tolerance, infinite where the outcome
/// cannot count (not finite, not at rest), and behind all others where something cannot pass or is not
/// to be moved so far.
pub(super) fn final_score(task: &Task, trajectory: &Trajectory) -> f64 {
    let Some(frame) = trajectory.frames.last() else { return f64::INFINITY };
    let fatal = |warning: &Warning| warning.forbids_success() && !warning.blocks();
    if trajectory.warnings.iter().any(fatal) {
        return f64::INFINITY;
    }
    let score = finite_score(task, &frame.state);
    let stops = is_blocked(trajectory) || task.scene.not_kept(&frame.state).is_some();
    if stops { behind(score) } else { score }
}

/// Score of a state, infinite where it is not a number.
pub(super) fn finite_score(task: &Task, state: &State) -> f64 {
    let score = if state.is_finite() { task.score(state) } else { f64::NAN };
    if score.is_nan() { f64::INFINITY } else { score }
}

/// Whether something on the way of a rollout could not pass.
pub(super) fn is_blocked(trajectory: &Trajectory) -> bool {
    trajectory.warnings.iter().any(Warning::blocks)
}

/// The score, moved after those of all rollouts that are not blocked.
pub fn behind(score: f64) -> f64 {
    bare(score) + BEHIND
}

/// Whether a score comes after those of all rollouts that are not blocked.
pub fn is_behind(score: f64) -> bool {
    score >= BEHIND && score.is_finite()
}

/// The score without regard to whether something is in the way.
pub fn bare(score: f64) -> f64 {
    if is_behind(score) { score - BEHIND } else { score }
}
