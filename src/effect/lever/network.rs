//! Trained networks as models of lever-ups.

use std::path::Path;
use std::sync::LazyLock;

use rayon::prelude::*;
use thiserror::Error;

use crate::effect::{EffectModel, Trust};
use crate::network::{LeverCell, LeverSizes, LeverWeights, WeightsError};
use crate::outcome::{LeverTrajectory, Record, Trajectory};
use crate::scene::{LeverFeatures, ModelKind, ModelSpec, Scene};
use crate::task::{Job, LeverJob};

use super::{LeverInputs, LeverPrior, PriorSettings, courses, lever_inputs};

/// Reason why weights of lever-ups cannot be used.
#[derive(Debug, Error)]
pub enum LeverNetworkError {
    /// Weights that cannot be read, or do not belong to a lever-up network.
    #[error("{path}: {error}")]
    Weights {
        /// Path of the file.
        path: String,
        /// Error of the file.
        error: WeightsError,
    },
    /// Weights whose input widths contradict their card.
    #[error("the inputs of the weights do not match their card")]
    Inputs,
}

/// A network, alone or as a correction of the analytic model.
#[derive(Clone, Debug)]
pub struct LeverNetwork {
    cell: LeverCell,
    features: LeverFeatures,
    prior: Option<LeverPrior>,
}

impl LeverNetwork {
    /// Analytic model that the network corrects.
    pub const PRIOR: LeverPrior = LeverPrior { settings: PriorSettings::CORRECTED };

    /// Creates a network with these weights.
    ///
    /// # Errors
    /// Returns [`LeverNetworkError::Inputs`] if their input widths contradict the card.
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

    /// Returns the shipped network.
    ///
    /// # Errors
    /// Returns [`LeverNetworkError`] if the library contains a damaged file.
    pub fn shipped() -> Result<Self, LeverNetworkError> {
        let weights = LeverWeights::from_bytes(pushplan_models::LEVER).map_err(|error| {
            LeverNetworkError::Weights { path: "lever.safetensors".to_owned(), error }
        })?;
        Self::new(&weights)
    }

    /// Reads a weights file.
    ///
    /// # Errors
    /// Returns [`LeverNetworkError`] if it cannot be used.
    pub fn load(path: &Path) -> Result<Self, LeverNetworkError> {
        let named = |error| LeverNetworkError::Weights { path: path.display().to_string(), error };
        Self::new(&LeverWeights::load(path).map_err(named)?)
    }

    fn predict(&self, job: &LeverJob, prior: Option<&LeverTrajectory>) -> LeverTrajectory {
        let inputs = lever_inputs(self.features, job, prior);
        let predicted = self.cell.predict(&inputs.still, &inputs.moving);
        inputs.answer(&predicted, job, prior)
    }

    /// Returns a name that distinguishes the networks of a comparison.
    pub fn describe(&self) -> String {
        let prior = if self.prior.is_some() { "prior + " } else { "" };
        let feedback = if self.cell.feeds_back() { ", fed back" } else { "" };
        format!("{prior}LSTM, {}{feedback}", self.features)
    }

    /// Returns `true` for a learned kind of lever-up: a single plate on a plain table.
    pub fn knows(&self, job: &LeverJob) -> bool {
        job.scene.plates.len() == 1 && job.scene.blocks.is_empty()
    }

    /// Predicts lever-ups until everything rests.
    pub fn courses(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        match &self.prior {
            Some(prior) => {
                let courses = prior.courses(jobs);
                jobs.par_iter()
                    .zip(&courses)
                    .map(|(job, course)| self.predict(job, Some(course)))
                    .collect()
            }
            None => jobs.par_iter().map(|job| self.predict(job, None)).collect(),
        }
    }
}

impl EffectModel for LeverNetwork {
    fn spec(&self) -> &ModelSpec {
        static SPEC: LazyLock<ModelSpec> = LazyLock::new(|| ModelKind::NETWORK.into());
        &SPEC
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        courses::trust(scene, job, |job| self.knows(job))
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        courses::rollout(self.spec(), (scene, jobs), record, |jobs| self.courses(jobs))
    }
}
