//! What the weights of a network of lever-ups are.

use serde::{Deserialize, Serialize};

use crate::network::{
    Card, Layout, Statistics, Weights, WeightsError,
    weights::{check_scales, check_widths},
};
use crate::scene::LeverFeatures;

use super::layout::{LeverSizes, lever_layout};

/// The weights of a network of lever-ups.
pub type LeverWeights = Weights<LeverCard>;

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverCard {
    /// What it is told of the shape.
    pub features: LeverFeatures,
    /// Whether it corrects the prior.
    pub prior: bool,
    /// Widths.
    pub sizes: LeverSizes,
    /// Scales of features of a lever-up.
    pub still: Statistics,
    /// Scales of features of a frame.
    pub moving: Statistics,
    /// Lever-ups that it was trained on.
    pub episodes: u64,
    /// Optimiser steps taken.
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
