//! States between the steps of a plan.

use crate::scene::{Engine, State};

use super::Evidence;

/// Returns the states before the first of `steps` steps and after each step, from a replay in 3-D
/// that begins in `start`, as far as it was recorded.
pub fn step_states(start: &State, steps: usize, evidence: &[Evidence]) -> Vec<State> {
    let mut states = vec![start.clone()];
    let nominal =
        evidence.iter().find(|one| one.engine == Engine::Spatial && one.trajectory.is_some());
    let frames = nominal.and_then(|one| one.trajectory.as_ref()).map_or(&[][..], |t| &t.frames);
    for step in 0..steps {
        let last = frames.iter().rfind(|frame| frame.stroke == step);
        states.extend(last.map(|frame| frame.state.clone()));
    }
    states
}
