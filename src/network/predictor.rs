//! The weights of the physics predictor and their card.

use serde::{Deserialize, Serialize};

use crate::scene::Ranges;

use super::{
    Config, Doubt, Normaliser, Tables, layout,
    parameters::Layout,
    weights::{Card, Weights, WeightsError, check_config, check_normaliser},
};

/// Maximum held-out error that a card may state, metres: longer than any table.
const LARGEST_ERROR: f64 = 100.0;

/// Factors on propagated states that a card may state.
const ROW_SCALES: std::ops::RangeInclusive<f32> = 1e-3..=1e3;

/// The weights of the physics predictor.
pub type PredictorWeights = Weights<PredictorCard>;

/// Errors on held-out pushes, for use in planning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorCard {
    /// Number of held-out pushes (true motion over 1 cm).
    pub pushes: usize,
    /// Mean error of the final position, metres.
    pub mean: f64,
    /// Median error, metres.
    pub median: f64,
    /// 95th percentile of the error, metres.
    pub p95: f64,
}

/// A data set from which weights were trained.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Source of the ground truth, with the version of a third-party engine.
    pub truth: String,
    /// Random seed of the episodes.
    pub seed: u64,
    /// Number of episodes.
    pub episodes: u64,
    /// Checksum over all episodes, hexadecimal.
    pub digest: String,
}

/// Description and provenance of the weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictorCard {
    /// Network size.
    pub config: Config,
    /// Feature scales.
    pub normaliser: Normaliser,
    /// Ranges of the training data.
    pub ranges: Ranges,
    /// Training data sets.
    pub sources: Vec<Source>,
    /// Number of optimiser steps.
    pub steps: u64,
    /// Errors of final positions of one object on the training's own held-out episodes, if there
    /// were any.
    pub errors: Option<ErrorCard>,
    /// Factor on the trained correction: 1 until the best factor over all ground truths was
    /// measured.
    pub share: f32,
    /// Factor that scales the propagated states to a mean square of one over training data, for
    /// heads and the estimate of errors.
    pub row_scale: f32,
    /// Estimate of the network's own error, if it was learned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<Doubt>,
}

impl Card for PredictorCard {
    const KEY: &'static str = "pushplan";
    const FORMAT: u32 = 7;

    fn check(&self) -> Result<(), WeightsError> {
        check_config(self.config)?;
        check_normaliser(&self.normaliser, &Tables::PUSHES)?;
        if let Some((name, value)) = self.ranges.unsound() {
            let (name, expected) = (format!("ranges.{name}"), "a number up to the upper limit");
            return Err(WeightsError::Value { name, value, expected });
        }
        if !ROW_SCALES.contains(&self.row_scale) {
            let (name, value) = ("row_scale".to_owned(), f64::from(self.row_scale));
            return Err(WeightsError::Value { name, value, expected: "0.001 to 1000" });
        }
        if let Some(doubt) = &self.doubt {
            doubt.check(self.config.half())?;
        }
        let Some(ErrorCard { mean, median, p95, .. }) = self.errors else { return Ok(()) };
        for (name, value) in [("mean", mean), ("median", median), ("p95", p95)] {
            if !(0.0..=LARGEST_ERROR).contains(&value) {
                let name = format!("errors.{name}");
                return Err(WeightsError::Value { name, value, expected: "0 to 100 m" });
            }
        }
        Ok(())
    }

    fn layout(&self) -> Layout {
        layout(&self.config)
    }
}
