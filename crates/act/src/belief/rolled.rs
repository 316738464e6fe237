//! Rollout of a window, sampled at its observations.

use pushplan::{outcome::Trajectory, scene::State, task::Observation};

/// States at the observations of a window.
pub(super) struct Rolled {
    pub states: Vec<State>,
}

impl Rolled {
    /// Samples a trajectory at the observations of a window. After an early stop, the last state is
    /// repeated.
    pub fn new(trajectory: &Trajectory, window: &[Observation], start: &State) -> Self {
        let mut strokes = 0;
        let states = window
            .iter()
            .map(|observation| {
                strokes += observation.strokes.len();
                let until = trajectory.frames.iter().rev().find(|frame| frame.stroke < strokes);
                until.map_or_else(|| start.clone(), |frame| frame.state.clone())
            })
            .collect();
        Self { states }
    }
}
