//! Trained networks as models of lever-ups.

use std::path::Path;

use rayon::prelude::*;
use thiserror::Error;

use crate::network::{LeverCell, LeverSizes, LeverWeights, WeightsError};
use crate::{outcome::LeverTrajectory, scene::LeverFeatures, task::LeverJob};

use super::{LeverInputs, LeverModel, LeverPrior, LeverTrust, PriorSettings, lever_inputs};

/// Why weights of lever-ups cannot be used.
#[derive(Debug, Error)]
pub enum LeverNetworkError {
    /// They cannot be read, or are no such weights.
    #[error("{path}: {error}")]
    Weights {
        /// Of the file.
        path: String,
        /// Why.
        error: WeightsError,
    },
    /// They are told other features than these.
    #[error("the weights have other inputs than their card says")]
    Inputs,
}

/// A network, alone or as a correction of the prior.
#[derive(Clone, Debug)]
pub struct LeverNetwork {
    cell: LeverCell,
    features: LeverFeatures,
    prior: Option<LeverPrior>,
}

impl LeverNetwork {
    /// What is corrected.
    pub const PRIOR: LeverPrior = LeverPrior { settings: PriorSettings::CORRECTED };

    /// Of these weights.
    ///
    /// # Errors
    /// [`LeverNetworkError::Inputs`] if their widths do not fit what the card says they are told.
    pub fn new(weights: &LeverWeights) -> Result<Self, LeverNetworkError> {
        let card = &weights.card;
        let sizes = LeverInputs::sizes(card.features, card.prior, card.sizes.width);
        if (LeverSizes { feedback: card.sizes.feedback, ..sizes }) != card.sizes {
            return Err(LeverNetworkError::Inputs);
        }
        Ok(Self {
            cell: LeverCell::new(weights),
            features: card.features,
            prior: card.prior.then_some(Self::PRIOR),
        })
    }

    /// The shipped network.
    ///
    /// # Errors
    /// [`LeverNetworkError`] if the library was built around a damaged file.
    pub fn shipped() -> Result<Self, LeverNetworkError> {
        let weights = LeverWeights::from_bytes(pushplan_models::LEVER).map_err(|error| {
            LeverNetworkError::Weights { path: "lever.safetensors".to_owned(), error }
        })?;
        Self::new(&weights)
    }

    /// Reads a weights file.
    ///
    /// # Errors
    /// [`LeverNetworkError`] if it cannot be used.
    pub fn load(path: &Path) -> Result<Self, LeverNetworkError> {
        let named = |error| LeverNetworkError::Weights { path: path.display().to_string(), error };
        Self::new(&LeverWeights::load(path).map_err(named)?)
    }

    fn predict(&self, job: &LeverJob, prior: Option<&LeverTrajectory>) -> LeverTrajectory {
        let inputs = lever_inputs(self.features, job, prior);
        let told = self.cell.predict(&inputs.still, &inputs.moving);
        inputs.answer(&told, job, prior)
    }
}

impl LeverModel for LeverNetwork {
    fn name(&self) -> String {
        let prior = if self.prior.is_some() { "prior + " } else { "" };
        let feedback = if self.cell.feeds_back() { ", fed back" } else { "" };
        format!("{prior}LSTM, {}{feedback}", self.features)
    }

    fn trust(&self, job: &LeverJob) -> LeverTrust {
        // It has learned of plates on a plain table.
        let alone = job.scene.plates.len() == 1 && job.scene.blocks.is_empty();
        if alone { LeverTrust::Mine { p95: None } } else { LeverTrust::NotMine }
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        match &self.prior {
            Some(prior) => {
                let said = prior.rollout(jobs);
                jobs.par_iter()
                    .zip(&said)
                    .map(|(job, said)| self.predict(job, Some(said)))
                    .collect()
            }
            None => jobs.par_iter().map(|job| self.predict(job, None)).collect(),
        }
    }
}
