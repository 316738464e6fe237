//! Settings of a training run except its episodes, and its score.

use std::fmt;

use pushplan::internals::effect::LeverInputs;
use pushplan::internals::network::{LeverCard, LeverSizes, Statistics};
use pushplan::internals::scene::LeverFeatures;
use serde::{Deserialize, Serialize};

use crate::dataset::{LeverConfig, LeverEpisode};
use crate::train::Descent;

/// Settings of a run; apart from the data, the defaults are the settings of the shipped weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverSettings {
    /// Shape features.
    pub features: LeverFeatures,
    /// Whether the network corrects the analytic model.
    pub prior: bool,
    /// Width of the hidden state, H.
    pub width: usize,
    /// Seed of initial weights and batches.
    pub seed: u64,
    /// Optimisation settings.
    pub descent: Descent,
    /// Whether the pose of the previous frame is an input: the true pose in training, the predicted
    /// one in rollouts.
    pub feedback: bool,
    /// Whether frames from a slip on are excluded.
    pub cut: bool,
    /// Whether the data are one part of a random split over lever-ups.
    pub split: bool,
    /// Data sets for training.
    pub data: Vec<LeverConfig>,
    /// Number of corners of plates that are excluded from the data.
    pub left_out: Option<usize>,
}

impl LeverSettings {
    /// Returns the widths of the network.
    pub fn sizes(&self) -> LeverSizes {
        let sizes = LeverInputs::sizes(self.features, self.prior, self.width);
        LeverSizes { feedback: self.feedback, ..sizes }
    }

    /// Returns the card after `steps` steps on this many `episodes`, with the feature scales per
    /// lever-up and per frame.
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

    /// Returns the episodes of `held_out` that came to rest without a jam, reduced to the frames
    /// that count.
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

/// Errors on held-out lever-ups.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LeverScore {
    /// Mean over lever-ups of the root mean square distance of the centre of mass over the
    /// rotation, metres.
    pub lift: f64,
    /// Mean distance at the end of the rotation, metres.
    pub last: f64,
    /// Share of correctly predicted slips.
    pub slips: f64,
    /// Share of correctly predicted endings.
    pub endings: f64,
}

/// Summary for the progress display.
impl fmt::Display for LeverScore {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [lift, last] = [self.lift, self.last].map(|metres| 1e3 * metres);
        let [slips, endings] = [self.slips, self.endings].map(|share| 1e2 * share);
        write!(f, "lift {lift:.2} mm, end {last:.2} mm, slips {slips:.1} %, endings {endings:.1} %")
    }
}
