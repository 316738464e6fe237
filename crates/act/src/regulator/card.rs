//! Card of the belief regulator's weights.

use serde::{Deserialize, Serialize};

use pushplan::network::{
    Card, Layout, Statistics, Weights, WeightsError, check_scales, check_widths,
};

use super::layout::regulator_layout;

/// Weights of the belief regulator.
pub type RegulatorWeights = Weights<RegulatorCard>;

/// Dimensions and origin of the weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegulatorCard {
    /// Number of features of a pair, F.
    pub features: usize,
    /// Width of the hidden state, H.
    pub width: usize,
    /// Means and deviations of the features.
    pub scales: Statistics,
    /// Seed of the training data.
    pub data_seed: u64,
    /// Number of training episodes.
    pub episodes: u64,
    /// Number of optimiser steps.
    pub steps: u64,
}

impl Card for RegulatorCard {
    const KEY: &'static str = "pushplan-regulator";
    const FORMAT: u32 = 2;

    fn check(&self) -> Result<(), WeightsError> {
        check_widths(self.width, &[self.features])?;
        check_scales("scales", &self.scales, self.features)
    }

    fn layout(&self) -> Layout {
        regulator_layout(self.features, self.width)
    }
}
