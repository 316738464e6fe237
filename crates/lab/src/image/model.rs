//! Networks with image input as models of lever-ups.

use pushplan::internals::effect::{LeverInputs, LeverNetwork, LeverNetworkError, LeverPrior};
use pushplan::internals::network::{
    LeverCell, LeverSizes, LeverWeights, Parameters, Statistics, tanh,
};
use pushplan::internals::{outcome::LeverTrajectory, scene::LeverFeatures, task::LeverJob};
use pushplan_learn::lever_model::LeverModel;
use rayon::prelude::*;

use super::{ImageFeatures, ImageSizes, ImageWeights, image_code, image_inputs};

/// A network, alone or as a correction of the analytic model.
#[derive(Clone, Debug)]
pub struct ImageNetwork {
    features: ImageFeatures,
    sizes: ImageSizes,
    /// Parameters of the convolutions.
    parameters: Parameters,
    /// Recurrent cell, which receives the code as further features of the lever-up.
    cell: LeverCell,
    prior: Option<LeverPrior>,
}

impl ImageNetwork {
    /// Creates the model of these weights.
    ///
    /// # Errors
    /// Returns [`LeverNetworkError::Inputs`] if their widths do not fit the inputs that the card
    /// states.
    pub fn new(weights: &ImageWeights) -> Result<Self, LeverNetworkError> {
        let card = &weights.card;
        let (mut memory, sizes) = (card.memory.clone(), card.image);
        let LeverSizes { width, feedback, .. } = memory.sizes;
        let expected = LeverInputs::sizes(LeverFeatures::Nothing, memory.prior, width);
        if (LeverSizes { feedback, ..expected }) != memory.sizes
            || [sizes.rows, sizes.columns] != card.features.extents()
        {
            return Err(LeverNetworkError::Inputs);
        }
        memory.sizes.still += sizes.code;
        let Statistics { mean, deviation } = &mut memory.still;
        mean.resize(memory.sizes.still, 0.0);
        deviation.resize(memory.sizes.still, 1.0);
        let mut parameters = weights.parameters.clone();
        let of_code = parameters.values.remove("gates.image").unwrap_or_default();
        parameters.values.entry("gates.still".to_owned()).or_default().extend(of_code);
        let (sees, parameters) =
            parameters.values.into_iter().partition(|(name, _)| name.starts_with("image"));
        let prior = memory.prior.then_some(LeverNetwork::PRIOR);
        let parameters = Parameters { values: parameters };
        let cell = LeverCell::new(&LeverWeights { card: memory, parameters });
        let (features, parameters) = (card.features, Parameters { values: sees });
        Ok(Self { features, sizes, parameters, cell, prior })
    }

    fn predict(&self, job: &LeverJob, prior: Option<&LeverTrajectory>) -> LeverTrajectory {
        let (inputs, image) = image_inputs(self.features, job, prior);
        let code = image_code(&self.sizes, &self.parameters, &image);
        let still: Vec<f32> =
            inputs.still.iter().copied().chain(code.into_iter().map(tanh)).collect();
        inputs.answer(&self.cell.predict(&still, &inputs.moving), job, prior)
    }
}

impl LeverModel for ImageNetwork {
    fn name(&self) -> String {
        let prior = if self.prior.is_some() { "prior + " } else { "" };
        let feedback = if self.cell.feeds_back() { ", fed back" } else { "" };
        format!("{prior}LSTM, {}{feedback}", self.features)
    }

    fn takes(&self, job: &LeverJob) -> bool {
        // It was trained on plates on a plain table.
        job.scene.plates.len() == 1 && job.scene.blocks.is_empty()
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        let predicted = self.prior.as_ref().map(|prior| prior.rollout(jobs));
        let predicted = |k: usize| predicted.as_ref().map(|predicted| &predicted[k]);
        jobs.par_iter().enumerate().map(|(k, job)| self.predict(job, predicted(k))).collect()
    }
}
