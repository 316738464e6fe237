//! The weights of a lever-up network and their card.

use serde::{Deserialize, Serialize};

use crate::network::{
    Card, Layout, Statistics, Weights, WeightsError,
    weights::{check_scales, check_widths},
};
use crate::scene::LeverFeatures;

use super::layout::{LeverSizes, lever_layout};

/// The weights of a lever-up network.
pub type LeverWeights = Weights<LeverCard>;

/// Description and provenance of the weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverCard {
    /// Shape features that the network receives.
    pub features: LeverFeatures,
    /// Whether the network corrects the analytic model.
    pub prior: bool,
    /// Widths of the network.
    pub sizes: LeverSizes,
    /// Scales of features of a lever-up.
    pub still: Statistics,
    /// Scales of features of a frame.
    pub moving: Statistics,
    /// Number of lever-ups in the training data.
    pub episodes: u64,
    /// Number of optimiser steps.
    pub steps: u64,
}

impl Card for LeverCard {
    const KEY: &'static str = "pushplan-lever";
    const FORMAT: u32 = 1;

    fn check(&self) -> Result<(), WeightsError> {
        let LeverSizes { still, moving, width, .. } = self.sizes;
        check_widths(width, &[still, moving])?;
        check_scales("still", &self.still, still)?;
        check_scales("moving", &self.moving, moving)
    }

    fn layout(&self) -> Layout {
        lever_layout(&self.sizes)
    }
}
