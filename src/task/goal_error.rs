//! Error of a state against a goal: the largest error of its demands.

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

    /// Returns the distance of the object's centre from the goal, metres. For an area, a gap or an
    /// edge, the distance from its core, which keeps a margin, counts. Returns 0 without a demand
    /// on the position.
    pub fn error(&self, state: &State) -> f64 {
        self.off(state).norm()
    }

    /// Returns the offset of the object's centre from the nearest wanted position, metres. It
    /// belongs to the demand with the largest error in units of its tolerance; zero without a
    /// demand on the position.
    pub fn off(&self, state: &State) -> Vector {
        let far = |(off, within): &(Vector, f64)| off.norm() / within;
        let worse = |a: (Vector, f64), b: (Vector, f64)| if far(&b) > far(&a) { b } else { a };
        self.offs(state).reduce(worse).map_or(Vector::zeros(), |(off, _)| off)
    }

    /// Returns the nearest wanted position, or the centre of the area, metres in the world; the
    /// world's origin without a demand on the position.
    pub fn place(&self, state: &State) -> Vector {
        if !self.has_place() {
            return Vector::zeros();
        }
        let place = self.in_world(state).position().filter(|_| !self.is_relation());
        place.unwrap_or_else(|| state.poses[self.subject(state)].position - self.off(state))
    }

    /// Returns the rotation from the wanted heading, or the nearest equivalent one, to the heading
    /// of the object, radians to the left. Returns `None` without a demand on the heading. For a
    /// joint with limits the rotation stays within them, and may be the longer one.
    pub fn turned(&self, state: &State) -> Option<f64> {
        let end = End::resting(self.object, state);
        let turns = self.demands.iter().filter_map(|demand| demand.kind().turned(&end));
        turns.reduce(|a, b| if b.abs() > a.abs() { b } else { a })
    }

    /// Returns the absolute heading error, radians, or `None` without a demand on the heading.
    pub fn heading_error(&self, state: &State) -> Option<f64> {
        self.turned(state).map(f64::abs)
    }

    /// Returns the smallest covered share of an outline, or `None` without such a demand.
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

    /// Returns the error in units of the tolerance, the largest of all demands: at most 1 is
    /// success. The search minimises this number, so that all demands have equal weight.
    pub fn score(&self, state: &State) -> f64 {
        self.score_after(state, None)
    }

    /// Returns the [score](Self::score) after a lift.
    pub fn score_after(&self, state: &State, lift: Option<Lift>) -> f64 {
        let end = End { object: self.object, state, lift };
        let scores = self.demands.iter().map(|demand| demand.kind().score(&end));
        // A NaN score is never hidden by another.
        scores.fold(0.0, |a: f64, b: f64| if a.is_nan() || a >= b { a } else { b })
    }
}
