//! What the weights of the physics predictor are.

use serde::{Deserialize, Serialize};

use crate::scene::Ranges;

use super::{
    Config, Doubt, Normaliser, Tables, layout,
    parameters::Layout,
    weights::{Card, Weights, WeightsError, check_config, check_normaliser},
};

/// Largest held-out error that a card may state, metres: longer than any table.
const LARGEST_ERROR: f64 = 100.0;

/// The weights of the physics predictor.
pub type PredictorWeights = Weights<PredictorCard>;

/// Held-out errors that planning needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorCard {
    /// Held-out pushes counted (true motion over 1 cm).
    pub pushes: usize,
    /// Mean final position error, metres.
    pub mean: f64,
    /// Median, metres.
    pub median: f64,
    /// 95th percentile, metres.
    pub p95: f64,
}

/// Data that weights have learned from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Who said what is true, with the version of an engine that is not ours.
    pub truth: String,
    /// Seed of the episodes.
    pub seed: u64,
    /// Their number.
    pub episodes: u64,
    /// Checksum over all of them, hexadecimal.
    pub digest: String,
}

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictorCard {
    /// Network size.
    pub config: Config,
    /// Feature scales.
    pub normaliser: Normaliser,
    /// Ranges of the training data.
    pub ranges: Ranges,
    /// The training data.
    pub sources: Vec<Source>,
    /// Optimiser steps taken.
    pub steps: u64,
    /// Errors of final positions, one object, on the training's own held-out episodes, if there
    /// were any.
    pub errors: Option<ErrorCard>,
    /// How much of the correction as trained counts: 1 until it was measured what serves every truth.
    pub share: f32,
    /// How far off it expects to be, if that was learned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<Doubt>,
}

impl Card for PredictorCard {
    const KEY: &'static str = "pushplan";
    const FORMAT: u32 = 5;

    fn check(&self) -> Result<(), WeightsError> {
        check_config(self.config)?;
        check_normaliser(&self.normaliser, &Tables::PUSHES)?;
        if let Some((name, value)) = self.ranges.unsound() {
            let (name, expected) = (format!("ranges.{name}"), "a number up to its upper end");
            return Err(WeightsError::Value { name, value, expected });
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
