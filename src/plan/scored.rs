//! What the search makes of every way to push: the best that it leads to, or why it cannot be done.

use serde::{Deserialize, Serialize};

use super::{CandidatePush, Infeasible, Start};

/// More ways than this are not kept: a thousand times what a reader can look at, it only bounds
/// what a file with thousands of directions or offsets can ask for.
const MOST: usize = 100_000;

/// A kind of push, over all states that the search tried it from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScoredPush {
    /// Pushes of the sequences that end with it.
    pub pushes: usize,
    /// Index into the tools that were offered.
    pub tool: usize,
    /// Turn of the end effector against world +x, radians.
    pub grip_yaw: f64,
    /// Heading of the motion, radians from world +x.
    pub direction: f64,
    /// Start, as tried from the first state.
    pub start: Start,
    /// The best score that was predicted: error in units of the tolerance, behind all others where
    /// something could not pass (see [`super::is_behind`]). `None` if it was not rolled out, or
    /// led to no rest.
    pub score: Option<f64>,
    /// Why it cannot be made, as found last; a way with a score can be made from another state.
    pub refused: Option<Infeasible>,
}

/// All ways to push that a search went through.
#[derive(Clone, Debug, Default)]
pub(super) struct Scores {
    list: Vec<ScoredPush>,
    /// Grips of the present length of sequence, each with the place of its first way.
    grips: Vec<((usize, f64), Option<usize>)>,
    pushes: usize,
}

impl Scores {
    /// Returns the results so far.
    pub fn list(&self) -> &[ScoredPush] {
        &self.list
    }

    /// Goes on to sequences of one push more.
    pub fn deepen(&mut self) {
        self.pushes += 1;
        self.grips.clear();
    }

    /// Place of the first of `ways`, which are as many and in the same order for every state;
    /// `None` if they are too many to be kept.
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

    /// Notes that the way at `place` cannot be made from a state.
    pub fn refuse(&mut self, place: Option<usize>, reason: Infeasible) {
        if let Some(way) = place.and_then(|place| self.list.get_mut(place)) {
            way.refused = Some(reason);
        }
    }

    /// Notes what the way at `place` leads to from a state.
    pub fn improve(&mut self, place: Option<usize>, score: f64) {
        if let Some(way) = place.and_then(|place| self.list.get_mut(place)) {
            way.score = Some(way.score.map_or(score, |best| best.min(score)));
        }
    }
}
