//! What is believed about one pair of objects.

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
    relative::relative,
    stops::Stops,
    window::{Doubt, Instant},
};

/// Types of joints, *none* among them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointType {
    /// The two are not joined.
    None,
    /// They move as one body.
    Fixed,
    /// One turns about a point of the other.
    Revolute,
    /// One slides along a line of the other.
    Prismatic,
}

impl JointType {
    /// All of them, in the order of probabilities.
    pub const ALL: [Self; 4] = [Self::None, Self::Fixed, Self::Revolute, Self::Prismatic];

    /// What a joint is; without one, none.
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

/// What is thought of near pairs before anything has moved: half of them are joined, and all types of
/// joints are as frequent.
const PRIOR: [f64; 4] = [0.5, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0];

/// Share of anchors midway between two objects and of axes along their line of centres; how exactly,
/// and where the others are: standard deviations of anchors, metres, and axes, radians.
const REGULAR: f64 = 0.6;
const MIDWAY: [f64; 2] = [3e-3, 25e-3];
const ALONG: [f64; 2] = [0.05, 0.35];

/// Axes in other directions are looked for around so many, evenly spaced over half a turn.
const DIRECTIONS: usize = 4;

/// No hypothesis falls further behind the best than this, as a logarithm, so that it can come back.
const FLOOR: f64 = -25.0;

/// What a single window can say for or against a hypothesis, as a logarithm.
const MOST: f64 = 8.0;

/// From here on a joint is taken for sure when several are ranked, and by how much fixed ones come
/// first: logarithms.
const SURE: f64 = 6.0;
const FIRST: f64 = 10.0;

/// Share of pairs that are joined themselves among those that move as if they were and whose motion
/// also follows from likelier joints: 19 of 88 in dense sets of 9 objects.
const FOLLOWS: f64 = 0.2;

/// A joint of some type somewhere, and how likely it is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hypothesis {
    pub log: f64,
    pub fit: Fit,
    pub stops: Stops,
}

impl Hypothesis {
    fn new(log: f64, fit: Fit) -> Self {
        Self { log, fit, stops: Stops::new() }
    }
}

/// What is believed about a pair of objects.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PairBelief {
    /// Indices of the two in the scene, the lower first.
    pub between: [usize; 2],
    pub hypotheses: Vec<Hypothesis>,
    /// The second in the frame of the first, at the start.
    start: Vector3<f64>,
    /// The point midway between their closest points, and the direction of their line of centres, both
    /// in the frame of the first, at the start.
    midway: Vector,
    line: f64,
    /// Probabilities of [`JointType::ALL`] as the regulator has them, if it told of the pair.
    pub regulated: Option<[f64; 4]>,
}

impl PairBelief {
    /// Before anything has moved: the pair was seen so, with this spread, `midway` lies between its
    /// closest points, in the frame of the first, and so likely it is `near` enough to be joined.
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

    /// Probabilities of [`JointType::ALL`]: the regulator's, or else the filter's.
    pub fn probabilities(&self, follows: bool) -> [f64; 4] {
        self.regulated.unwrap_or_else(|| self.filtered(follows))
    }

    /// Probabilities of [`JointType::ALL`] by the filter alone; where its motion also `follows` from
    /// other joints, it is joined itself with a fifth of what its motion says.
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

    /// The type that one window alone, whose evidence is `by_type`, would make it.
    pub fn by_window(by_type: &[f64; 4]) -> JointType {
        let logs =
            JointType::ALL.map(|kind| (by_type[kind as usize] + PRIOR[kind as usize].ln(), kind));
        let most = logs.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        most.map_or(JointType::None, |(_, kind)| kind)
    }

    /// The type that the regulator finds likeliest, or else the one that its motion is likest to.
    pub fn likeliest(&self) -> JointType {
        let shares = self.regulated.unwrap_or(JointType::ALL.map(|kind| self.log(kind)));
        let most = JointType::ALL.into_iter().zip(shares).max_by(|a, b| a.1.total_cmp(&b.1));
        most.map_or(JointType::None, |(kind, _)| kind)
    }

    /// The type to predict with: one of the joints as soon as these are likelier than none all together,
    /// though no single one may be. Two that are joined somehow go with each other, whatever holds them
    /// together.
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

    /// How much likelier the likeliest joint is than none, as a logarithm.
    pub fn joined(&self) -> f64 {
        let logs = match self.regulated {
            Some(shares) => shares.map(|share| share.max(LEAST).ln()),
            None => JointType::ALL.map(|kind| self.log(kind)),
        };
        logs[1..].iter().copied().fold(f64::NEG_INFINITY, f64::max) - logs[0]
    }

    /// Which of several pairs is likelier joined itself where each follows from the others: what one
    /// object of a rigid group does against a third, all of the group do. So fixed joints come first,
    /// then those whose anchor or axis is where one would put it between this pair. The regulator has taken
    /// that into account.
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

    /// The joint of that type where it most likely is, while the two objects stand at these poses; its
    /// `limits` are not known. `None` for no joint.
    pub fn joint(&self, kind: JointType, poses: [&Pose; 2]) -> Option<Joint> {
        let best = self.best(kind)?;
        Some(Joint::new(self.between, self.stopped(best, best.fit.joint(poses)?, poses)))
    }

    /// A joint of a hypothesis, with its stops, while the two objects stand at these poses.
    pub fn stopped(&self, of: &Hypothesis, kind: JointKind, [one, other]: [&Pose; 2]) -> JointKind {
        let now = relative(one, other);
        let limits = of.stops.limits(&of.fit, &self.start, &now);
        match kind {
            JointKind::Fixed => JointKind::Fixed,
            JointKind::Revolute { at, .. } => JointKind::Revolute { at, limits },
            JointKind::Prismatic { axis, .. } => JointKind::Prismatic { axis, limits },
        }
    }

    /// How far the likeliest anchor is from the point midway between the two, metres, and the sine of
    /// how far the likeliest axis is turned from their line of centres; and how surely either is known:
    /// standard deviations, metres and radians.
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

    /// The likeliest hypothesis of a type.
    pub fn best(&self, kind: JointType) -> Option<&Hypothesis> {
        self.of(kind).max_by(|a, b| a.log.total_cmp(&b.log))
    }

    /// Takes what a window says of every hypothesis, as logarithms, and `share` of it for true.
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

    /// Takes what was seen in a window, rolled out by type, into the geometry of every hypothesis.
    pub fn learn(&mut self, instants: &[Vec<Instant>; 4]) {
        for Hypothesis { fit, .. } in &mut self.hypotheses {
            fit.learn(&instants[fit.kind as usize]);
        }
    }

    /// Takes it into where joints stop; `doubts` are those of the rollouts.
    pub fn learn_stops(&mut self, instants: &[Vec<Instant>; 4], doubts: &[Option<Doubt>; 4]) {
        for Hypothesis { fit, stops, .. } in &mut self.hypotheses {
            if let Some(doubt) = &doubts[fit.kind as usize] {
                stops.learn(fit, &self.start, &instants[fit.kind as usize], doubt);
            }
        }
    }

    /// Takes over where joints stop.
    pub fn keep_stops(&mut self, of: &Self) {
        for (mine, theirs) in self.hypotheses.iter_mut().zip(&of.hypotheses) {
            mine.stops = theirs.stops;
        }
    }

    /// Counts the errors of unseen headings from other ones, by type and object: what those rolled
    /// out are above the new ones, or `None` for a heading that was seen in the end.
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

    /// The best evidence of each type, against the best of all.
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
    /// The joint while its two objects are tracked at these poses.
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
    fn what_the_regulator_says_counts_instead_of_the_filter() {
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
