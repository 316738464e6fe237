//! Everything that decides a training run besides its episodes, and what it reports.

use std::fmt;

use pushplan::internals::effect::LeverInputs;
use pushplan::internals::network::LeverSizes;
use pushplan::internals::scene::LeverFeatures;
use serde::{Deserialize, Serialize};

use crate::dataset::LeverConfig;
use crate::train::Descent;

/// Settings of a run; a checkpoint resumes only under the same ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverSettings {
    /// What the network is told of the shape.
    pub features: LeverFeatures,
    /// Whether it corrects the prior.
    pub prior: bool,
    /// Width of the hidden state, H.
    pub width: usize,
    /// Seed of first weights and batches.
    pub seed: u64,
    /// Lever-ups a step, B.
    pub batch: usize,
    /// Steps between held-out evaluations and checkpoints.
    pub evaluate_every: u64,
    /// How weights follow gradients.
    pub descent: Descent,
    /// Whether it is told the pose of the frame before: the true one when it learns, its own when it
    /// predicts.
    #[serde(default)]
    pub feedback: bool,
    /// Whether the frames from a slip on are left out.
    #[serde(default)]
    pub cut: bool,
    /// Whether the data are one part of a random split over lever-ups.
    #[serde(default)]
    pub split: bool,
    /// The families that it is trained on.
    pub data: Vec<LeverConfig>,
    /// Plates of this many corners are left out of them.
    pub left_out: Option<usize>,
}

impl LeverSettings {
    /// Widths of the network.
    pub(super) fn sizes(&self) -> LeverSizes {
        let sizes = LeverInputs::sizes(self.features, self.prior, self.width);
        LeverSizes { feedback: self.feedback, ..sizes }
    }
}

impl Default for LeverSettings {
    fn default() -> Self {
        Self {
            features: LeverFeatures::Support,
            prior: true,
            width: 56,
            seed: 1,
            batch: 64,
            evaluate_every: 1000,
            descent: Descent {
                steps: 8000,
                learning_rate: 3e-3,
                warm_up: 200,
                weight_decay: 0.02,
                clip: 1.0,
                average: 0.995,
            },
            feedback: false,
            cut: false,
            split: false,
            data: Vec::new(),
            left_out: None,
        }
    }
}

/// One line of `metrics.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverLine {
    /// Steps taken.
    pub step: u64,
    /// Mean loss since the last line.
    pub loss: f64,
    /// Mean gradient norm before clipping since the last line.
    pub gradient: f64,
    /// Learning rate.
    pub learning_rate: f64,
    /// Wall time of this process so far, seconds.
    pub seconds: f64,
    /// Of the averaged weights on held-out lever-ups.
    pub held_out: LeverScore,
}

/// Errors on lever-ups that were not learned from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LeverScore {
    /// Root mean square distance of the centre of mass over the turn, mean, metres.
    pub lift: f64,
    /// Distance at its end, mean, metres.
    pub last: f64,
    /// Share of slips told right.
    pub slips: f64,
    /// Share of endings told right.
    pub endings: f64,
}

impl fmt::Display for LeverLine {
    /// What a person wants to follow.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let LeverScore { lift, last, slips, endings } = self.held_out;
        write!(
            f,
            "step {:>6}  loss {:.4}  held out: lift {:.2} mm, end {:.2} mm, slips {:.1} %, endings {:.1} %",
            self.step,
            self.loss,
            1e3 * lift,
            1e3 * last,
            1e2 * slips,
            1e2 * endings
        )
    }
}
