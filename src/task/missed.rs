//! How far a state is off a goal, and whether it is reached.

use crate::geometry::{ContactPoint, Pose, Vector, wrap_angle};

use super::Goal;
use crate::scene::State;

impl Goal {
    /// `turn` without the turns after which the object looks the same, radians: the smallest left.
    pub fn least_turn(&self, turn: f64) -> f64 {
        let alike = self.alike as f64;
        wrap_angle(turn * alike) / alike
    }

    /// Distance of the object's centre from the goal, metres; of an area, a gap or an edge, from what lies
    /// deep enough inside or beyond; 0 where it may lie anywhere.
    pub fn error(&self, state: &State) -> f64 {
        self.off(state).norm()
    }

    /// From the nearest place that is asked for to the object's centre, metres; zero where it may lie
    /// anywhere.
    pub fn off(&self, state: &State) -> Vector {
        if !self.has_place() {
            return Vector::zeros();
        }
        if let Some(gap) = &self.gap {
            let Some(nearest) = self.nearest(state) else { return Vector::zeros() };
            return gap.beyond(nearest.gap, gap.depth()) * nearest.normal;
        }
        if let Some(fall) = &self.fall {
            return fall.off(fall.centre(&state.poses[self.object]) - self.position);
        }
        let goal = self.in_world(state);
        let at = state.poses[self.object].position;
        at - goal.area.map_or(goal.position, |area| area.nearest(at))
    }

    /// The gap that is asked for, where the object may be as far from it as the position says.
    fn nearest(&self, state: &State) -> Option<ContactPoint> {
        let mut shifted = state.poses.get(self.object).copied()?;
        shifted.position -= self.position;
        self.gap.as_ref()?.nearest(&shifted, state)
    }

    /// The nearest place that is asked for, or the middle of its area, metres in the world.
    pub fn place(&self, state: &State) -> Vector {
        match self.is_relation() {
            true => state.poses[self.object].position - self.off(state),
            false => self.in_world(state).position,
        }
    }

    /// The same as seen from the goal's own frame, metres along its axes.
    pub fn off_as_seen(&self, state: &State) -> Vector {
        let off = self.off(state);
        let relative = self.relative.filter(|_| !self.is_relation());
        let frame = relative.and_then(|other| state.poses.get(other));
        frame.map_or(off, |frame| frame.local_vector(off))
    }

    /// Turn from the wanted heading, or the nearest one that looks the same, to that of the object,
    /// radians to the left, where a heading is asked for; of what a joint with limits turns the way that
    /// they leave, which may be the longer one.
    pub fn turned(&self, state: &State) -> Option<f64> {
        let goal = self.in_world(state);
        let (wanted, _) = goal.heading?;
        let turn = self.least_turn(state.poses[self.object].heading - wanted);
        let Some(middle) = goal.middle else { return Some(turn) };
        // The way that the limits leave.
        let from_middle = wanted + turn - middle;
        Some(turn + (wrap_angle(from_middle) - from_middle))
    }

    /// Absolute heading error, radians, where a heading is asked for.
    pub fn heading_error(&self, state: &State) -> Option<f64> {
        self.turned(state).map(f64::abs)
    }

    /// The share of its outline at the goal that the object covers, where that is asked for.
    pub fn covered(&self, state: &State) -> Option<f64> {
        let goal = self.in_world(state);
        let heading = goal.heading.map_or(0.0, |(heading, _)| heading);
        let wanted = Pose { position: goal.position, heading };
        Some(goal.coverage?.covered(&state.poses[self.object], &wanted))
    }

    /// Whether position (and heading, where asked for) are within tolerance, or enough is covered.
    pub fn reached(&self, state: &State) -> bool {
        if let Some(coverage) = &self.coverage {
            return self.covered(state).is_some_and(|covered| covered >= coverage.share);
        }
        let turned = match (self.heading, self.heading_error(state)) {
            (Some((_, tolerance)), Some(error)) => error <= tolerance,
            _ => true,
        };
        let own = &state.poses[self.object];
        let there = match (&self.gap, &self.fall, self.in_world(state).area) {
            (Some(gap), ..) => self.nearest(state).is_some_and(|nearest| gap.holds(nearest.gap)),
            (_, Some(fall), _) => fall.holds(fall.centre(own) - self.position),
            (.., Some(area)) => area.holds(own.position),
            _ => self.error(state) <= self.tolerance,
        };
        there && turned
    }

    /// Error in units of the tolerance, the larger of position and heading: at most 1 is
    /// success. This is what the search minimises, so that both demands count alike.
    pub fn score(&self, state: &State) -> f64 {
        let position = match self.has_place() {
            true => self.error(state) / self.tolerance,
            false => 0.0,
        };
        let score = match (self.heading, self.heading_error(state)) {
            (Some((_, tolerance)), Some(error)) => position.max(error / tolerance),
            _ => position,
        };
        if self.coverage.is_none() || score.is_nan() {
            return score;
        }
        if self.reached(state) { score.min(1.0) } else { score.max(1.0f64.next_up()) }
    }
}
