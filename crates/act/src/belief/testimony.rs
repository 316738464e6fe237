//! What a window tells of every pair, as numbers for the regulator.

use serde::{Deserialize, Serialize};

use pushplan::task::Noise;

use super::pair::{JointType, PairBelief};

/// Number of features of a pair without the effects of propagation.
pub const EVIDENCE: usize = 51;

/// What one window told of every pair.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Testimony {
    /// [P, F], [`EVIDENCE`] numbers and then the effects of propagation; zeros of a pair of which
    /// nothing was told.
    pub features: Vec<f32>,
    /// Of which pairs anything was told.
    pub told: Vec<bool>,
    /// The filter's probabilities of [`JointType::ALL`] after the window.
    pub filtered: Vec<[f64; 4]>,
}

/// What windows told of all pairs before they were looked at together, in a push whose windows were
/// taken again after that.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Draft {
    /// How many of the windows that count in the end came before the push.
    pub after: usize,
    /// Those of the push.
    pub windows: Vec<Testimony>,
}

/// What was found of a pair when whole assignments of joints were compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Together {
    /// By type, how likely the best assignment is in which the pair is joined so, as a logarithm against
    /// the best of all.
    pub best: [f64; 4],
    /// Probabilities by the filter before that.
    pub before: [f64; 4],
}

/// What the filter found of a pair in a window.
pub(super) struct Judged {
    /// Of every hypothesis, as logarithms.
    pub evidence: Vec<f64>,
    /// Of the likeliest hypothesis of every type, how far the window's end is off in its three
    /// coordinates, in standard deviations.
    pub off: [[f64; 3]; 4],
    /// How far the two were seen to move against each other in the window: metres, radians.
    pub change: [f64; 2],
}

/// What of a window is the same for all of its pairs, or of the two objects of one.
pub(super) struct Circumstances {
    pub noise: Noise,
    /// Windows so far.
    pub windows: usize,
    /// How far the two moved over the table, metres.
    pub moved: [f64; 2],
    /// How far they have moved against each other since the start: metres, radians.
    pub worked: [f64; 2],
    /// Whether their headings were seen.
    pub headings: [bool; 2],
    /// Whether they are cylinders.
    pub cylinders: [bool; 2],
    /// What the likeliest physics takes them for.
    pub taken: JointType,
    /// Whether their motion also follows from likelier joints.
    pub follows: bool,
}

/// The features of a pair, all of the order of one: lengths are logarithms against 1 mm, angles
/// against 0.01 rad, so that noise and motion of any size stay apart. The last are zero where nothing was
/// compared `together`.
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
