//! Results of the search for every kind of push: the best score or the reason for rejection.

use serde::{Deserialize, Serialize};

use super::{CandidatePush, Infeasible, Start};

/// Maximum number of stored kinds of pushes. It exceeds a reader's needs a thousandfold and only
/// bounds files with thousands of directions or offsets.
const MOST: usize = 100_000;

/// Kind of push, over all states from which the search tried it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScoredPush {
    /// Number of pushes of the sequences that end with it.
    pub pushes: usize,
    /// Index of the tool among the offered ones.
    pub tool: usize,
    /// Rotation of the end effector relative to world +x, radians.
    pub grip_yaw: f64,
    /// Heading of the motion, radians from world +x.
    pub direction: f64,
    /// Start of the push from the first state.
    pub start: Start,
    /// Best predicted score: error in units of the tolerance, behind all others if the motion was
    /// blocked (see [`super::is_behind`]). `None` if the push was not rolled out or never came to
    /// rest.
    pub score: Option<f64>,
    /// Last reason why the push cannot be made. A push with a score is feasible from another state.
    pub refused: Option<Infeasible>,
}

/// Kinds of pushes considered by a search.
#[derive(Clone, Debug, Default)]
pub(super) struct Scores {
    list: Vec<ScoredPush>,
    /// Grips for the current sequence length, each with the index of its first push.
    grips: Vec<((usize, f64), Option<usize>)>,
    pushes: usize,
}

impl Scores {
    /// Returns the results so far.
    pub fn list(&self) -> &[ScoredPush] {
        &self.list
    }

    /// Starts sequences with one more push.
    pub fn deepen(&mut self) {
        self.pushes += 1;
        self.grips.clear();
    }

    /// Returns the index of the first of the pushes `ways`, which have the same number and order
    /// for every state. Returns `None` if they are too many to store.
    pub fn place(
        &mut self,
        pair: (usize, f64),
        ways: impl ExactSizeIterator<Item = CandidatePush>,
    ) -> Option<usize> {
        if let Some((_, place)) = self.grips.iter().find(|(known, _)| *known == pair) {
            return *place;
        }
        let first = self.list.len();
        let place = (first + ways.len() <= MOST).then_some(first);
        if place.is_some() {
            let pushes = self.pushes;
            self.list.extend(ways.map(|CandidatePush { start, direction, .. }| ScoredPush {
                pushes,
                tool: pair.0,
                grip_yaw: pair.1,
                direction,
                start,
                score: None,
                refused: None,
            }));
        }
        self.grips.push((pair, place));
        place
    }

    /// Records that the push at `place` cannot be made from a state.
    pub fn refuse(&mut self, place: Option<usize>, reason: Infeasible) {
        if let Some(way) = place.and_then(|place| self.list.get_mut(place)) {
            way.refused = Some(reason);
        }
    }

    /// Records the score of the push at `place` from a state.
    pub fn improve(&mut self, place: Option<usize>, score: f64) {
        if let Some(way) = place.and_then(|place| self.list.get_mut(place)) {
            way.score = Some(way.score.map_or(score, |best| best.min(score)));
        }
    }
}
