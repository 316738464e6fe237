//! Trained networks as models of lever-ups.

use std::path::Path;
use std::sync::Arc;

use rayon::prelude::*;
use thiserror::Error;

use crate::network::{LEVER_POSE, LeverCell, LeverSizes, LeverWeights, PartsWeights, WeightsError};
use crate::scene::{Ending, LEVER_FRAMES, LeverFeatures, LeverJob, LeverTrajectory, LeverWarning};

use super::{
    LeverInputs, LeverModel, LeverParts, LeverPrior, LeverTrust, LeverView, PriorSettings,
    lever_inputs,
};

/// Why weights of lever-ups cannot be used.
#[derive(Debug, Error)]
pub enum LeverNetworkError {
    /// They cannot be read.
    #[error("cannot read {path}: {error}")]
    File {
        /// Of the file.
        path: String,
        /// Why.
        error: std::io::Error,
    },
    /// They are no such weights.
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

/// Reads the weights of a network of lever-ups of either kind: a memory, or one of parts.
///
/// # Errors
/// [`LeverNetworkError`] if they cannot be used.
pub fn load_lever(path: &Path) -> Result<Arc<dyn LeverModel>, LeverNetworkError> {
    let name = || path.display().to_string();
    let bytes =
        std::fs::read(path).map_err(|error| LeverNetworkError::File { path: name(), error })?;
    let weights = |error| LeverNetworkError::Weights { path: name(), error };
    if PartsWeights::are_in(&bytes) {
        return Ok(Arc::new(LeverParts::new(&PartsWeights::from_bytes(&bytes).map_err(weights)?)));
    }
    Ok(Arc::new(LeverNetwork::new(&LeverWeights::from_bytes(&bytes).map_err(weights)?)?))
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
        let name = || path.display().to_string();
        let bytes =
            std::fs::read(path).map_err(|error| LeverNetworkError::File { path: name(), error })?;
        let weights = LeverWeights::from_bytes(&bytes)
            .map_err(|error| LeverNetworkError::Weights { path: name(), error })?;
        Self::new(&weights)
    }

    fn predict(&self, job: &LeverJob, prior: Option<&LeverTrajectory>) -> LeverTrajectory {
        let inputs = lever_inputs(self.features, job, prior);
        let told = self.cell.predict(&inputs.still, &inputs.image, &inputs.moving);
        let view = LeverView::new(job);
        let pose = |base: &[f32], told: &[f32]| {
            let sum: Vec<f32> = base.iter().zip(told).map(|(base, told)| base + told).collect();
            view.pose(&LeverInputs::seen(&sum))
        };
        let frames = LEVER_FRAMES * LEVER_POSE;
        let lift = inputs.base[..frames]
            .chunks_exact(LEVER_POSE)
            .zip(told.poses.chunks_exact(LEVER_POSE))
            .map(|(base, told)| pose(base, told))
            .collect();
        let slips = told.end[0] > 0.0;
        let endings = [Ending::Back, Ending::Flipped, Ending::Leaning];
        let best = (0..3).max_by(|a, b| told.end[1 + a].total_cmp(&told.end[1 + b]));
        LeverTrajectory {
            lift,
            held: prior.map_or_else(|| vec![!slips; LEVER_FRAMES], |prior| prior.held.clone()),
            rest: pose(&inputs.base[frames..], &told.end[4..]),
            ending: best.map_or(Ending::Back, |best| endings[best]),
            warnings: if slips { vec![LeverWarning::Slipped] } else { Vec::new() },
        }
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
