//! Everything that decides a training run besides its episodes, and what it reports.

use std::fmt;

use pushplan::internals::effect::LeverInputs;
use pushplan::internals::network::{LeverCard, LeverSizes, Statistics};
use pushplan::internals::scene::LeverFeatures;
use serde::{Deserialize, Serialize};

use crate::dataset::{LeverConfig, LeverEpisode};
use crate::train::Descent;

/// Settings of a run; the defaults are those of the shipped weights, but for the data.
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
    /// How weights follow gradients.
    pub descent: Descent,
    /// Whether it is told the pose of the frame before: the true one when it learns, its own when it
    /// predicts.
    pub feedback: bool,
    /// Whether the frames from a slip on are left out.
    pub cut: bool,
    /// Whether the data are one part of a random split over lever-ups.
    pub split: bool,
    /// The families that it is trained on.
    pub data: Vec<LeverConfig>,
    /// Plates of this many corners are left out of them.
    pub left_out: Option<usize>,
}

impl LeverSettings {
    /// Widths of the network.
    pub fn sizes(&self) -> LeverSizes {
        let sizes = LeverInputs::sizes(self.features, self.prior, self.width);
        LeverSizes { feedback: self.feedback, ..sizes }
    }

    /// The card after `steps` steps on this many `episodes`, with the scales of features of a lever-up
    /// and of a frame.
    pub fn card(&self, [still, moving]: [Statistics; 2], episodes: usize, steps: u64) -> LeverCard {
        LeverCard {
            features: self.features,
            prior: self.prior,
            sizes: self.sizes(),
            still,
            moving,
            episodes: episodes as u64,
            steps,
        }
    }

    /// Those of `held_out` that came to rest without a jam, as far as their frames count.
    pub fn judged_on(&self, held_out: &[LeverEpisode]) -> Vec<LeverEpisode> {
        let sound = held_out.iter().filter(|episode| episode.is_sound());
        sound
            .filter_map(|one| if self.cut { one.before_slip() } else { Some(one.clone()) })
            .collect()
    }
}

impl Default for LeverSettings {
    fn default() -> Self {
        Self {
            features: LeverFeatures::Support,
            prior: true,
            width: 56,
            seed: 1,
            descent: Descent {
                steps: 8000,
                batch: 64,
                evaluate_every: 1000,
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

/// What a person wants to follow.
impl fmt::Display for LeverScore {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [lift, last] = [self.lift, self.last].map(|metres| 1e3 * metres);
        let [slips, endings] = [self.slips, self.endings].map(|share| 1e2 * share);
        write!(f, "lift {lift:.2} mm, end {last:.2} mm, slips {slips:.1} %, endings {endings:.1} %")
    }
}
