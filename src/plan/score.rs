//! Scores of rollouts: the error in units of the tolerance, with blocked rollouts ranked last.

use crate::{
    outcome::{Trajectory, Warning},
    scene::State,
    task::Task,
};

/// Amount added to the score of a blocked rollout. It exceeds any error in units of a tolerance, so
/// that a blocked candidate is tried only if there is no other. Such candidates are not rejected,
/// because a prediction that is off by a few millimetres proves nothing.
const BEHIND: f64 = 1e6;

/// Returns the score of a finished rollout: the error in units of the tolerance. It is infinite if
/// the outcome is invalid (not finite, not at rest), and behind all others if the motion is blocked
/// or an object moves too far.
pub(super) fn final_score(task: &Task, trajectory: &Trajectory) -> f64 {
    let Some(frame) = trajectory.frames.last() else { return f64::INFINITY };
    let fatal = |warning: &Warning| warning.forbids_success() && !warning.blocks();
    if trajectory.warnings.iter().any(fatal) {
        return f64::INFINITY;
    }
    let score = finite_score(task, &frame.state);
    if is_blocked(trajectory) { behind(score) } else { score }
}

/// Returns the score of a state; infinite instead of NaN.
pub(super) fn finite_score(task: &Task, state: &State) -> f64 {
    let score = if state.is_finite() { task.score(state) } else { f64::NAN };
    if score.is_nan() { f64::INFINITY } else { score }
}

/// Returns `true` if a rollout was blocked.
pub(super) fn is_blocked(trajectory: &Trajectory) -> bool {
    trajectory.warnings.iter().any(Warning::blocks)
}

/// Returns the score moved behind the scores of all unblocked rollouts.
pub fn behind(score: f64) -> f64 {
    bare(score) + BEHIND
}

/// Returns `true` if a score is behind the scores of all unblocked rollouts.
pub fn is_behind(score: f64) -> bool {
    score >= BEHIND && score.is_finite()
}

/// Returns the score as if the rollout were unblocked.
pub fn bare(score: f64) -> f64 {
    if is_behind(score) { score - BEHIND } else { score }
}
