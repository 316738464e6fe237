//! The effect models that come with the library, weights included, from any directory.

use std::sync::Arc;

use crate::{
    brdpn::{Weights, WeightsError},
    sim::Simulator,
};

use super::{EffectModel, Learned, Simulated};

/// The trained weights that are part of the library; `models/brdpn.md` says what they are.
const WEIGHTS: &[u8] = include_bytes!("../../models/brdpn.safetensors");

/// Where effect models come from.
pub struct EffectModels;

impl EffectModels {
    /// The shipped weights with their card.
    ///
    /// # Errors
    /// [`WeightsError`] if the library was built around a damaged weights file.
    pub fn weights() -> Result<Weights, WeightsError> {
        Weights::from_bytes(WEIGHTS)
    }

    /// The learned model that planning uses by default.
    ///
    /// # Errors
    /// [`WeightsError`] if the library was built around a damaged weights file.
    pub fn shipped() -> Result<Arc<dyn EffectModel>, WeightsError> {
        Ok(Arc::new(Learned::new(Self::weights()?)))
    }

    /// The planar engine: the learned model's truth, several times slower.
    pub fn planar() -> Arc<dyn EffectModel> {
        Arc::new(Simulated::new(Simulator::planar()))
    }
}
