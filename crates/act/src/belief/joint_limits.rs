//! Joint limits, estimated from joints that stop although the rollout continues.
//!
//! A limit is identifiable only after the joint reached it, from the joint staying in place while
//! the tool pushes it further. Each side of a joint therefore has a *reach*, its maximum observed
//! displacement, and the odds that the joint is limited there.

use nalgebra::Vector3;

use pushplan::{geometry::Vector, scene::Span};

use super::{
    density::{log_sum, student_of_one},
    distributions::LOGISTIC,
    fit::Fit,
    pair::JointType,
    window::{Doubt, Instant, UNEVEN},
};

/// Prior share of joints with limits.
const LIMITED: f64 = 0.3;

/// Prior range of limits on either side: radians and metres.
const TURN: Span = Span::new(0.1, 1.0);
const SLIDE: Span = Span::new(0.02, 0.15);

/// Standard deviations of the play at a limit: radians and metres.
const PLAY: [f64; 2] = [5e-3, 5e-4];

/// Number of standard deviations beyond the reach at which the joint is known to have moved on.
const BEYOND: f64 = 2.0;

/// Maximum log-evidence of a window for or against a limit.
const MOST: f64 = 8.0;

/// Assumed limit of a side without a known limit if the other side has one.
///
/// The values are radians, within the range that engines accept, and metres.
pub const NO_STOP: [f64; 2] = [3.0, 10.0];

/// Estimated limits on both sides of the initial joint position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct JointLimits([Side; 2]);

/// Side of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    /// Maximum observed displacement, radians or metres, and its variance.
    reach: f64,
    variance: f64,
    /// Log-odds that the joint is limited at `reach`.
    odds: f64,
}

/// Displacement of a joint at the end of a window from its initial position: radians or metres.
struct Travel {
    seen: f64,
    variance: f64,
    /// Predicted displacement and its variance.
    rolled: f64,
    doubt: f64,
}

impl JointLimits {
    /// Creates the prior.
    pub fn new() -> Self {
        Self([Side { reach: 0.0, variance: 0.0, odds: prior() }; 2])
    }

    /// Updates the limits with a window in which two objects, initially at the relative pose
    /// `start`, were observed and rolled out.
    pub fn learn(&mut self, fit: &Fit, start: &Vector3<f64>, instants: &[Instant], doubt: &Doubt) {
        let Some(which) = coordinate(fit.kind) else { return };
        let Some(travel) = travel(fit, start, instants, doubt) else { return };
        for (side, sign) in self.0.iter_mut().zip([-1.0, 1.0]) {
            side.learn(&travel, sign, which);
        }
    }

    /// Returns the remaining range of a joint from its position `now`, if it has a limit.
    pub fn limits(&self, fit: &Fit, start: &Vector3<f64>, now: &Vector3<f64>) -> Option<Span> {
        let which = coordinate(fit.kind)?;
        let gone = gone(fit, start, now);
        let [low, high] = &self.0;
        let left = |side: &Side, sign: f64| match side.odds > 0.0 {
            true => (side.reach - sign * gone).max(0.0),
            false => NO_STOP[which],
        };
        let stops = low.odds > 0.0 || high.odds > 0.0;
        stops.then(|| Span::new(-left(low, -1.0), left(high, 1.0)))
    }
}

impl Side {
    /// Updates the odds with a displacement.
    ///
    /// Without a limit, the observation is distributed around the rollout. A limit concentrates all
    /// probability beyond it at the limit. If the joint exceeds its reach, the limit may be
    /// anywhere in the rest of the range. If the joint returns to its reach, the limit is there.
    /// Other positions are uninformative.
    fn learn(&mut self, travel: &Travel, sign: f64, which: usize) {
        let range = [TURN, SLIDE][which];
        let (seen, rolled) = (sign * travel.seen, sign * travel.rolled);
        let play = PLAY[which].powi(2);
        let free = travel.variance + travel.doubt + play;
        let going_on = student_of_one(seen - rolled, free);
        // Log-probability of reaching at least this displacement without a limit.
        let beyond = |far: f64| -(-LOGISTIC * (rolled - far) / free.sqrt()).exp().ln_1p();
        let sd = (travel.variance + self.variance + play).sqrt();
        if seen > self.reach + BEYOND * sd {
            let left = range.high - self.reach.max(range.low);
            *self = Self { reach: seen, variance: travel.variance, odds: prior() };
            if seen + BEYOND * sd > range.low && left > 0.0 {
                self.weigh(beyond(seen) - left.ln() - going_on);
            }
        } else if seen > (self.reach - BEYOND * sd).max(range.low - BEYOND * sd) {
            let stopped = beyond(self.reach) + student_of_one(seen - self.reach, sd * sd);
            self.weigh(log_sum([stopped - going_on, 0.5f64.ln()].into_iter()));
            let share = self.variance / (self.variance + travel.variance + 1e-12);
            self.reach += share * (seen - self.reach);
            self.variance *= 1.0 - share;
        }
    }

    fn weigh(&mut self, evidence: f64) {
        self.odds += evidence.clamp(-MOST, MOST);
    }
}

fn prior() -> f64 {
    (LIMITED / (1.0 - LIMITED)).ln()
}

/// Returns the index of the free coordinate, angle or length, if the joint moves.
fn coordinate(kind: JointType) -> Option<usize> {
    match kind {
        JointType::Revolute => Some(0),
        JointType::Prismatic => Some(1),
        JointType::None | JointType::Fixed => None,
    }
}

/// Returns the displacement of a joint from `start` for the relative pose `now`.
fn gone(fit: &Fit, start: &Vector3<f64>, now: &Vector3<f64>) -> f64 {
    match fit.kind {
        JointType::Revolute => now.z - start.z,
        _ => axis(fit).dot(&(now.xy() - start.xy())),
    }
}

fn axis(fit: &Fit) -> Vector {
    Vector::new(fit.mean.x.cos(), fit.mean.x.sin())
}

/// Returns the displacement at the last instant; `None` if a heading was not observed.
fn travel(fit: &Fit, start: &Vector3<f64>, instants: &[Instant], doubt: &Doubt) -> Option<Travel> {
    let last = instants.last().filter(|last| last.headings == [true; 2])?;
    let (mut weight, mut off, mut noise) = (0.0, 0.0, 0.0);
    let across = |of: &nalgebra::Matrix3<f64>| match fit.kind {
        JointType::Revolute => of[(2, 2)],
        _ => {
            let axis = axis(fit);
            (axis.transpose() * of.fixed_view::<2, 2>(0, 0) * axis)[0]
        }
    };
    for now in instants.iter().filter(|now| now.headings == [true; 2]) {
        let look = now.look(&fit.errors);
        let far = |of: &Vector3<f64>| gone(fit, start, of);
        weight += now.share * now.share;
        off += now.share * (far(&look.seen) - far(&look.predicted));
        noise = across(&look.spread);
    }
    let look = last.look(&fit.errors);
    let [seen, rolled] = [look.seen, look.predicted].map(|at| gone(fit, start, &at));
    if !rolled.is_finite() {
        return None;
    }
    let which = coordinate(fit.kind)?;
    // The error of a rollout grows linearly unless a limit is reached.
    let even = last.share * off / weight;
    let uneven = (UNEVEN * even).powi(2) + noise / weight;
    let share = noise / (noise + uneven).max(1e-12);
    Some(Travel {
        seen: seen + share * (rolled + even - seen),
        variance: (1.0 - share) * noise + across(&doubt.start),
        rolled,
        doubt: doubt.model[1 - which].powi(2),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Side of a prismatic joint after windows with these observed and predicted displacements,
    /// metres.
    fn slid(windows: &[[f64; 2]]) -> Side {
        let mut side = Side { reach: 0.0, variance: 0.0, odds: prior() };
        for [seen, rolled] in windows {
            let doubt = 2e-3f64.powi(2);
            let travel = Travel { seen: *seen, variance: 1e-8, rolled: *rolled, doubt };
            side.learn(&travel, 1.0, 1);
        }
        side
    }

    #[test]
    fn a_joint_stops_where_it_stayed_though_a_rollout_went_on() {
        let on = [[0.01, 0.01], [0.02, 0.021], [0.03, 0.029]];
        assert!(slid(&on).odds < 0.0);
        let stayed = [&on[..], &[[0.0352, 0.04], [0.0349, 0.045]]].concat();
        let side = slid(&stayed);
        assert!(side.odds > 2.0 && (side.reach - 0.035).abs() < 3e-4, "{side:?}");
        // Resting at a limit, returning from it or stopping short of it is uninformative.
        let after = [&stayed[..], &[[0.035, 0.035], [0.02, 0.022], [0.025, 0.034]]].concat();
        assert!(slid(&after).odds > 2.0);
        // A joint that later moves further was not at a limit.
        let beyond = [&after[..], &[[0.045, 0.044]]].concat();
        assert!(slid(&beyond).odds < 0.0);
    }

    #[test]
    fn one_that_outruns_its_rollout_or_hardly_moved_did_not_stop() {
        assert!(slid(&[[0.05, 0.02]]).odds < 0.0);
        assert!(slid(&[[0.002, 0.01], [0.002, 0.01], [0.002, 0.01]]).odds < 0.0);
    }
}
