//! Features of every window and pair for the regulator.

use serde::{Deserialize, Serialize};

use pushplan::task::Noise;

use super::pair::{JointType, PairBelief};

/// Number of features of a pair without propagation effects.
pub const EVIDENCE: usize = 51;

/// Features of all pairs in one window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegulatorFeatures {
    /// Features [P, F]: [`EVIDENCE`] numbers, then the propagation effects; zeros for uninformative
    /// pairs.
    pub features: Vec<f32>,
    /// Whether the window was informative, per pair.
    pub informative: Vec<bool>,
    /// Filter's probabilities of [`JointType::ALL`] after the window.
    pub filtered: Vec<[f64; 4]>,
}

/// First version of the windows of a push, recorded before joint inference replaced them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Draft {
    /// Number of final windows before the push.
    pub after: usize,
    /// Windows of the push.
    pub windows: Vec<RegulatorFeatures>,
}

/// Result of the joint inference for a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Together {
    /// Log-likelihood of the best assignment with each joint type, relative to the best of all.
    pub best: [f64; 4],
    /// Filter's probabilities before the inference.
    pub before: [f64; 4],
}

/// Result of the filter for a pair and window.
pub(super) struct Judged {
    /// Log-evidence of every hypothesis.
    pub evidence: Vec<f64>,
    /// Final residual of the window in the three joint coordinates, in standard deviations, for the
    /// most probable hypothesis of every type.
    pub off: [[f64; 3]; 4],
    /// Observed relative displacement in the window: metres, radians.
    pub change: [f64; 2],
}

/// Circumstances of a window that all hypotheses about a pair share.
pub(super) struct Circumstances {
    pub noise: Noise,
    /// Number of windows so far.
    pub windows: usize,
    /// Displacement of each object over the table, metres.
    pub moved: [f64; 2],
    /// Relative displacement since the start: metres, radians.
    pub worked: [f64; 2],
    /// Whether each heading was observed.
    pub headings: [bool; 2],
    /// Whether each object is a cylinder.
    pub cylinders: [bool; 2],
    /// Type in the most probable physics.
    pub taken: JointType,
    /// Whether the motion also follows from more probable joints.
    pub follows: bool,
}

/// Returns the features of a pair, all of order one.
///
/// Lengths are logarithms relative to 1 mm and angles relative to 0.01 rad, which separates noise
/// from motion of any size. The last features are zero without a result `together` of the joint
/// inference.
pub(super) fn features(
    pair: &PairBelief,
    judged: &Judged,
    around: &Circumstances,
    together: Option<&Together>,
) -> [f32; EVIDENCE] {
    let length = |x: f64| (x / 1e-3).ln_1p();
    let angle = |x: f64| (x / 1e-2).ln_1p();
    let number = |yes: bool| f64::from(u8::from(yes));
    let mut row = Vec::with_capacity(EVIDENCE);
    row.extend(pair.by_type(&judged.evidence).map(|log| log.max(-20.0) / 5.0));
    row.extend(pair.filtered(around.follows).map(|share| share.max(1e-6).ln() / 4.0));
    row.extend(judged.off.iter().flatten().map(|off| off.ln_1p().min(5.0)));
    let [worked, turned] = around.worked;
    row.extend([length(judged.change[0]), angle(judged.change[1]), length(worked), angle(turned)]);
    let [one, other] = around.moved;
    row.extend([length(one.min(other)), length(one.max(other))]);
    row.extend([length(around.noise.position), angle(around.noise.heading)]);
    let [one, other] = around.headings;
    row.extend([number(one && other), number(one || other)]);
    let [anchor, axis, anchor_sd, axis_sd] = pair.places();
    row.extend([length(anchor), axis, length(anchor_sd), angle(axis_sd)]);
    row.push(number(around.follows));
    row.extend(JointType::ALL.map(|kind| number(kind == around.taken)));
    row.push(0.5 * around.cylinders.iter().map(|round| number(*round)).sum::<f64>());
    row.extend([1.0, (around.windows as f64).ln_1p()]);
    if let Some(Together { best, before }) = together {
        row.extend(best.map(|log| log.max(-20.0) / 5.0));
        row.extend(before.map(|share| share.max(1e-6).ln() / 4.0));
        row.push(1.0);
    }
    let mut features = [0.0; EVIDENCE];
    for (feature, value) in features.iter_mut().zip(row) {
        *feature = if value.is_finite() { value as f32 } else { 0.0 };
    }
    features
}
