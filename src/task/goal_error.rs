//! Error of a state against a goal: the worst of its demands.

use crate::geometry::Vector;
use crate::scene::State;

use super::Goal;
use super::demand::{Demand, End, Lift};

impl Goal {
    fn offs(&self, state: &State) -> impl Iterator<Item = (Vector, f64)> {
        let end = End::resting(self.object, state);
        let kinds = self.demands.iter().map(Demand::kind);
        kinds.filter_map(move |kind| kind.off(&end).zip(kind.tolerance()))
    }

    /// Distance of the object's centre from the goal, metres; of an area, a gap or an edge, from what lies
    /// deep enough inside or beyond; 0 where it may lie anywhere.
    pub fn error(&self, state: &State) -> f64 {
        self.off(state).norm()
    }

    /// From the nearest wanted place to the object's centre, metres, for the demand that is missed by most
    /// tolerances; zero where it may lie anywhere.
    pub fn off(&self, state: &State) -> Vector {
        let far = |(off, within): &(Vector, f64)| off.norm() / within;
        let worse = |a: (Vector, f64), b: (Vector, f64)| if far(&b) > far(&a) { b } else { a };
        self.offs(state).reduce(worse).map_or(Vector::zeros(), |(off, _)| off)
    }

    /// The nearest wanted place, or the centre of its area, metres in the world; the world's origin where
    /// the object may lie anywhere.
    pub fn place(&self, state: &State) -> Vector {
        if !self.has_place() {
            return Vector::zeros();
        }
        let place = self.in_world(state).position().filter(|_| !self.is_relation());
        place.unwrap_or_else(|| state.poses[self.subject(state)].position - self.off(state))
    }

    /// Turn from the wanted heading, or the nearest one that looks the same, to that of the object, radians
    /// to the left, where a heading is asked for; of what a joint with limits turns the way that they leave,
    /// which may be the longer one.
    pub fn turned(&self, state: &State) -> Option<f64> {
        let end = End::resting(self.object, state);
        let turns = self.demands.iter().filter_map(|demand| demand.kind().turned(&end));
        turns.reduce(|a, b| if b.abs() > a.abs() { b } else { a })
    }

    /// Absolute heading error, radians, where a heading is asked for.
    pub fn heading_error(&self, state: &State) -> Option<f64> {
        self.turned(state).map(f64::abs)
    }

    /// The smallest share of an outline that the object covers, where one is asked for.
    pub fn covered(&self, state: &State) -> Option<f64> {
        let end = End::resting(self.object, state);
        self.demands.iter().filter_map(|demand| demand.kind().covered(&end)).reduce(f64::min)
    }

    /// Returns `true` if every demand is satisfied by an object that no blade has lifted.
    pub fn reached(&self, state: &State) -> bool {
        self.is_met(state, None)
    }

    /// Returns `true` if every demand is satisfied after a lift.
    pub fn is_met(&self, state: &State, lift: Option<Lift>) -> bool {
        let end = End { object: self.object, state, lift };
        self.demands.iter().all(|demand| demand.kind().is_met(&end))
    }

    /// Error in units of the tolerance, the largest of all demands: at most 1 is success. This is what the
    /// search minimises, so that all demands count alike.
    pub fn score(&self, state: &State) -> f64 {
        self.score_after(state, None)
    }

    /// The [score](Self::score) after a lift.
    pub fn score_after(&self, state: &State, lift: Option<Lift>) -> f64 {
        let end = End { object: self.object, state, lift };
        let scores = self.demands.iter().map(|demand| demand.kind().score(&end));
        // A score that is no number is never hidden by another.
        scores.fold(0.0, |a: f64, b: f64| if a.is_nan() || a >= b { a } else { b })
    }
}
