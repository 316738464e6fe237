//! Belief about one pair of objects.

use std::fmt;

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use pushplan::{
    geometry::{Pose, Vector},
    scene::{Joint, JointKind},
};

use crate::regulator::LEAST;

use super::{
    density::log_sum,
    fit::Fit,
    joint_limits::JointLimits,
    relative::relative,
    window::{Doubt, Instant},
};

/// Joint type of a pair, including *none*.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointType {
    /// No joint.
    None,
    /// Fixed joint: both objects move as one body.
    Fixed,
    /// Revolute joint: one object rotates about a point of the other.
    Revolute,
    /// Prismatic joint: one object slides along a line of the other.
    Prismatic,
}

impl JointType {
    /// Array of all types, in the order of probabilities.
    pub const ALL: [Self; 4] = [Self::None, Self::Fixed, Self::Revolute, Self::Prismatic];

    /// Returns the type of a joint; [`JointType::None`] without one.
    pub fn of(joint: Option<&Joint>) -> Self {
        match joint.map(|joint| joint.kind) {
            None => Self::None,
            Some(JointKind::Fixed) => Self::Fixed,
            Some(JointKind::Revolute { .. }) => Self::Revolute,
            Some(JointKind::Prismatic { .. }) => Self::Prismatic,
        }
    }
}

impl fmt::Display for JointType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "none",
            Self::Fixed => "fixed",
            Self::Revolute => "revolute",
            Self::Prismatic => "prismatic",
        })
    }
}

/// Prior probabilities of near pairs: half are joined, with equally frequent joint types.
const PRIOR: [f64; 4] = [0.5, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0];

/// Share of regular anchors (midway) and axes (along the line of centres), and standard
/// deviations of regular and other anchors, metres, and axes, radians.
const REGULAR: f64 = 0.6;
const MIDWAY: [f64; 2] = [3e-3, 25e-3];
const ALONG: [f64; 2] = [0.05, 0.35];

/// Number of evenly spaced directions around which irregular axes are searched for.
const DIRECTIONS: usize = 4;

/// Lower bound of a hypothesis's log-weight relative to the best, so that it can recover.
const FLOOR: f64 = -25.0;

/// Maximum log-evidence of a single window for or against a hypothesis.
const MOST: f64 = 8.0;

/// Log-odds above which a joint counts as certain for ranking, and bonus of fixed joints.
const SURE: f64 = 6.0;
const FIRST: f64 = 10.0;

/// Probability that a pair is itself joined if it moves so but its motion also follows from more
/// probable joints: 19 of 88 in dense sets of 9 objects.
const FOLLOWS: f64 = 0.2;

/// Joint of some type and geometry, with its log-weight.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hypothesis {
    pub log: f64,
    pub fit: Fit,
    pub stops: JointLimits,
}

impl Hypothesis {
    fn new(log: f64, fit: Fit) -> Self {
        Self { log, fit, stops: JointLimits::new() }
    }
}

/// Belief about a pair of objects.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PairBelief {
    /// Indices of the objects in the scene, the lower one first.
    pub between: [usize; 2],
    pub hypotheses: Vec<Hypothesis>,
    /// Initial pose of the second object in the frame of the first.
    start: Vector3<f64>,
    /// Midpoint between the closest points, and direction of the line of centres, both in the
    /// initial frame of the first object.
    midway: Vector,
    line: f64,
    /// Regulator's probabilities of [`JointType::ALL`], if it corrects the pair.
    pub regulated: Option<[f64; 4]>,
}

impl PairBelief {
    /// Creates the prior for a pair observed at the relative pose `seen` with covariance `spread`.
    ///
    /// `midway` is the midpoint between the closest points, in the frame of the first object.
    /// `near` is the probability that the objects are close enough to be joined.
    pub fn new(
        between: [usize; 2],
        seen: Vector3<f64>,
        spread: &Matrix3<f64>,
        midway: Vector,
        near: f64,
    ) -> Self {
        let prior = |kind: JointType| match kind {
            JointType::None => 1.0 - near * (1.0 - PRIOR[0]),
            _ => near * PRIOR[kind as usize],
        };
        let line = seen.y.atan2(seen.x);
        let mut hypotheses = vec![
            Hypothesis::new(prior(JointType::None).ln(), Fit::none()),
            Hypothesis::new(prior(JointType::Fixed).ln(), Fit::fixed(&seen, spread)),
        ];
        for (share, far) in [REGULAR, 1.0 - REGULAR].into_iter().zip(MIDWAY) {
            let fit = Fit::revolute(&seen, spread, midway, far);
            hypotheses.push(Hypothesis::new((prior(JointType::Revolute) * share).ln(), fit));
        }
        let fit = Fit::prismatic(&seen, spread, line, ALONG[0]);
        hypotheses.push(Hypothesis::new((prior(JointType::Prismatic) * REGULAR).ln(), fit));
        for k in 0..DIRECTIONS {
            let angle = line + std::f64::consts::PI * k as f64 / DIRECTIONS as f64;
            let fit = Fit::prismatic(&seen, spread, angle, ALONG[1]);
            let share = (1.0 - REGULAR) / DIRECTIONS as f64;
            hypotheses.push(Hypothesis::new((prior(JointType::Prismatic) * share).ln(), fit));
        }
        Self { between, hypotheses, start: seen, midway, line, regulated: None }
    }

    /// Returns the probabilities of [`JointType::ALL`]: the regulator's, otherwise the filter's.
    pub fn probabilities(&self, follows: bool) -> [f64; 4] {
        self.regulated.unwrap_or_else(|| self.filtered(follows))
    }

    /// Returns the filter's probabilities of [`JointType::ALL`].
    ///
    /// If the motion also `follows` from other joints, the joint probabilities are multiplied by
    /// [`FOLLOWS`].
    pub fn filtered(&self, follows: bool) -> [f64; 4] {
        let logs = JointType::ALL.map(|kind| self.log(kind));
        let all = log_sum(logs.into_iter());
        let [none, joints @ ..] = logs.map(|log| (log - all).exp());
        let joints = joints.map(|share| if follows { FOLLOWS * share } else { share });
        [
            if follows { 1.0 - joints.iter().sum::<f64>() } else { none },
            joints[0],
            joints[1],
            joints[2],
        ]
    }

    /// Returns the most probable type given the evidence of one window alone, by type.
    pub fn by_window(by_type: &[f64; 4]) -> JointType {
        let logs =
            JointType::ALL.map(|kind| (by_type[kind as usize] + PRIOR[kind as usize].ln(), kind));
        let most = logs.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        most.map_or(JointType::None, |(_, kind)| kind)
    }

    /// Returns the regulator's most probable type, otherwise the filter's.
    pub fn likeliest(&self) -> JointType {
        let shares = self.regulated.unwrap_or(JointType::ALL.map(|kind| self.log(kind)));
        let most = JointType::ALL.into_iter().zip(shares).max_by(|a, b| a.1.total_cmp(&b.1));
        most.map_or(JointType::None, |(kind, _)| kind)
    }

    /// Returns the type for predictions.
    ///
    /// A joint type is used as soon as all joint types together are more probable than none. Joined
    /// objects move together, whatever the joint type is.
    pub fn supposed(&self) -> JointType {
        match self.regulated {
            Some([none, joints @ ..]) if none < 0.5 => {
                let each = JointType::ALL[1..].iter().copied().zip(joints);
                let most = each.max_by(|a, b| a.1.total_cmp(&b.1));
                most.map_or(JointType::None, |(kind, _)| kind)
            }
            _ => self.likeliest(),
        }
    }

    /// Returns the log-odds of the most probable joint against none.
    pub fn joined(&self) -> f64 {
        let logs = match self.regulated {
            Some(shares) => shares.map(|share| share.max(LEAST).ln()),
            None => JointType::ALL.map(|kind| self.log(kind)),
        };
        logs[1..].iter().copied().fold(f64::NEG_INFINITY, f64::max) - logs[0]
    }

    /// Returns the rank of a pair among pairs whose joints would close a loop.
    ///
    /// Objects of a rigid group all move alike relative to a third, so fixed joints rank first.
    /// Then come joints whose anchor or axis is regular for the pair. The regulator already
    /// accounts for this.
    pub fn rank(&self) -> f64 {
        if self.regulated.is_some() {
            return self.joined();
        }
        let kind = self.likeliest();
        let place = match (kind, self.best(kind).map(|best| best.fit.mean)) {
            (JointType::Revolute, Some(mean)) => {
                let far = (mean.xy() - self.midway).norm_squared();
                let of = |share: f64, sd: f64| share / (sd * sd) * (-0.5 * far / (sd * sd)).exp();
                let shares = [REGULAR, 1.0 - REGULAR];
                let density: f64 = shares.into_iter().zip(MIDWAY).map(|(a, b)| of(a, b)).sum();
                (density * MIDWAY[1] * MIDWAY[1]).max(1e-6).ln()
            }
            (JointType::Prismatic, Some(mean)) => {
                let off = ((mean.x - self.line).sin() / ALONG[0]).powi(2);
                let wide = std::f64::consts::PI / (ALONG[0] * std::f64::consts::TAU.sqrt());
                (REGULAR * wide * (-0.5 * off).exp() + 1.0 - REGULAR).ln()
            }
            (JointType::Fixed, _) => FIRST,
            _ => 0.0,
        };
        self.joined().min(SURE) + place
    }

    /// Returns the most probable joint of a type while the objects have these poses; `None` for no
    /// joint.
    pub fn joint(&self, kind: JointType, poses: [&Pose; 2]) -> Option<Joint> {
        let best = self.best(kind)?;
        Some(Joint::new(self.between, self.stopped(best, best.fit.joint(poses)?, poses)))
    }

    /// Returns the joint of a hypothesis, with its limits, while the objects have these poses.
    pub fn stopped(&self, of: &Hypothesis, kind: JointKind, [one, other]: [&Pose; 2]) -> JointKind {
        let now = relative(one, other);
        let limits = of.stops.limits(&of.fit, &self.start, &now);
        match kind {
            JointKind::Fixed => JointKind::Fixed,
            JointKind::Revolute { at, .. } => JointKind::Revolute { at, limits },
            JointKind::Prismatic { axis, .. } => JointKind::Prismatic { axis, limits },
        }
    }

    /// Returns how irregular the most probable anchor and axis are.
    ///
    /// The first two values are the distance of the anchor from the midpoint, metres, and the sine
    /// of the angle between axis and line of centres. The others are the standard deviations of
    /// anchor and axis, metres and radians.
    pub fn places(&self) -> [f64; 4] {
        let [mut anchor, mut axis, mut anchor_sd, mut axis_sd] = [0.0; 4];
        if let Some(best) = self.best(JointType::Revolute) {
            anchor = (best.fit.mean.xy() - self.midway).norm();
            anchor_sd = (best.fit.covariance[(0, 0)] + best.fit.covariance[(1, 1)]).sqrt();
        }
        if let Some(best) = self.best(JointType::Prismatic) {
            axis = (best.fit.mean.x - self.line).sin().abs();
            axis_sd = best.fit.covariance[(0, 0)].sqrt();
        }
        [anchor, axis, anchor_sd, axis_sd]
    }

    /// Returns the most probable hypothesis of a type.
    pub fn best(&self, kind: JointType) -> Option<&Hypothesis> {
        self.of(kind).max_by(|a, b| a.log.total_cmp(&b.log))
    }

    /// Adds a `share` of the log-evidence of a window to every hypothesis.
    pub fn weigh(&mut self, evidence: &[f64], share: f64) {
        let most = evidence.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if most == f64::NEG_INFINITY {
            return;
        }
        for (hypothesis, evidence) in self.hypotheses.iter_mut().zip(evidence) {
            hypothesis.log += share * (evidence - most).max(-MOST);
        }
        let logs = self.hypotheses.iter().map(|hypothesis| hypothesis.log);
        let most = logs.fold(f64::NEG_INFINITY, f64::max);
        for hypothesis in &mut self.hypotheses {
            hypothesis.log = (hypothesis.log - most).max(FLOOR);
        }
    }

    /// Updates the geometry of every hypothesis with a window, rolled out by type.
    pub fn learn(&mut self, instants: &[Vec<Instant>; 4]) {
        for Hypothesis { fit, .. } in &mut self.hypotheses {
            fit.learn(&instants[fit.kind as usize]);
        }
    }

    /// Updates the joint limits with a window; `doubts` are the uncertainties of the rollouts.
    pub fn learn_stops(&mut self, instants: &[Vec<Instant>; 4], doubts: &[Option<Doubt>; 4]) {
        for Hypothesis { fit, stops, .. } in &mut self.hypotheses {
            if let Some(doubt) = &doubts[fit.kind as usize] {
                stops.learn(fit, &self.start, &instants[fit.kind as usize], doubt);
            }
        }
    }

    /// Copies the joint limits of another belief.
    pub fn keep_stops(&mut self, of: &Self) {
        for (mine, theirs) in self.hypotheses.iter_mut().zip(&of.hypotheses) {
            mine.stops = theirs.stops;
        }
    }

    /// Measures the errors of unobserved headings from new tracked headings, by type and object.
    ///
    /// `above` is the rolled-out heading minus the new one, or `None` if the final heading was
    /// observed.
    pub fn recount(&mut self, above: &[[Option<f64>; 2]; 4]) {
        for Hypothesis { fit, .. } in &mut self.hypotheses {
            for (k, above) in above[fit.kind as usize].iter().enumerate() {
                match above {
                    Some(above) => fit.errors[k] += above,
                    None => fit.forget(k, 0.0, 0.0),
                }
            }
        }
    }

    /// Returns the best evidence of each type, relative to the best of all.
    pub fn by_type(&self, evidence: &[f64]) -> [f64; 4] {
        let most = evidence.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        JointType::ALL.map(|kind| {
            let of = self.hypotheses.iter().zip(evidence).filter(|(one, _)| one.fit.kind == kind);
            of.map(|(_, evidence)| evidence - most).fold(f64::NEG_INFINITY, f64::max)
        })
    }

    fn of(&self, kind: JointType) -> impl Iterator<Item = &Hypothesis> + Clone {
        self.hypotheses.iter().filter(move |hypothesis| hypothesis.fit.kind == kind)
    }

    fn log(&self, kind: JointType) -> f64 {
        log_sum(self.of(kind).map(|hypothesis| hypothesis.log))
    }
}

impl Fit {
    /// Returns the joint while its two objects are tracked at these poses.
    pub(super) fn joint(&self, poses: [&Pose; 2]) -> Option<JointKind> {
        let m = &self.mean;
        let [first, second] =
            [0, 1].map(|k| Pose { heading: poses[k].heading + self.errors[k], ..*poses[k] });
        match self.kind {
            JointType::None => None,
            JointType::Fixed => Some(JointKind::Fixed),
            JointType::Revolute => {
                let at = 0.5 * (first.point(m.xy()) + second.point(Vector::new(m.z, m.w)));
                Some(JointKind::Revolute { at, limits: None })
            }
            JointType::Prismatic => {
                let axis = first.vector(Vector::new(m.x.cos(), m.x.sin()));
                Some(JointKind::Prismatic { axis, limits: None })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_regulator_replaces_the_filter() {
        let spread = Matrix3::from_diagonal(&Vector3::new(1e-8, 1e-8, 1e-6));
        let seen = Vector3::new(0.1, 0.0, 0.0);
        let mut pair = PairBelief::new([0, 1], seen, &spread, Vector::new(0.05, 0.0), 1.0);
        assert_eq!(pair.probabilities(false), pair.filtered(false));
        assert_eq!(pair.likeliest(), JointType::None);
        pair.regulated = Some([0.3, 0.6, 0.09, 0.01]);
        assert_eq!(pair.probabilities(true), [0.3, 0.6, 0.09, 0.01]);
        assert_eq!(pair.likeliest(), JointType::Fixed);
        assert!((pair.joined() - 2.0_f64.ln()).abs() < 1e-12);
        assert_eq!(pair.rank(), pair.joined());
        pair.regulated = Some([0.4, 0.3, 0.2, 0.1]);
        assert_eq!(pair.likeliest(), JointType::None);
        assert_eq!(pair.supposed(), JointType::Fixed);
    }
}
