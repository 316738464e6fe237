//! What the weights of the belief regulator are.

use serde::{Deserialize, Serialize};

use pushplan::network::{
    Card, Layout, Statistics, Weights, WeightsError, check_scales, check_widths,
};

use super::layout::regulator_layout;

/// The weights of the belief regulator.
pub type RegulatorWeights = Weights<RegulatorCard>;

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegulatorCard {
    /// Number of features of a pair, F.
    pub features: usize,
    /// Width of the hidden state, H.
    pub width: usize,
    /// Feature scales.
    pub scales: Statistics,
    /// Seed of the training data.
    pub data_seed: u64,
    /// Training episodes.
    pub episodes: u64,
    /// Optimiser steps taken.
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
