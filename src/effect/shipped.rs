//! The effect models that come with the library, weights included, from any directory.

use std::sync::Arc;

use crate::{
    network::{Weights, WeightsError},
    sim::{DEFAULT_STEP, Simulator},
};

use super::{EffectModel, Follow, Network, Prior, Projection, Simulated, Still};

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
        Ok(Arc::new(Network::new(Self::weights()?)))
    }

    /// The model of this name, as [`EffectModel::name`] gives it: the shipped network, its prior,
    /// an engine at any step, or one without physics.
    ///
    /// # Errors
    /// [`WeightsError`] if the library was built around a damaged weights file.
    pub fn named(name: &str) -> Result<Option<Arc<dyn EffectModel>>, WeightsError> {
        let (plain, rate) = match name.strip_suffix(" s").and_then(|name| name.split_once(", 1/")) {
            Some((plain, rate)) => (plain, rate.parse().ok()),
            None => (name, None),
        };
        let step = rate.map_or(DEFAULT_STEP, |rate: f64| 1.0 / rate);
        Ok(Some(match plain {
            "planar" => Arc::new(Simulated::new(Simulator::planar_with_step(step))),
            "3d" => Arc::new(Simulated::new(Simulator::spatial_with_step(step))),
            "quasi-static" => Arc::new(Prior::default()),
            "projection" => Arc::new(Projection),
            "follow" => Arc::new(Follow),
            "still" => Arc::new(Still),
            _ => return Ok(Some(Self::shipped()?).filter(|shipped| shipped.name() == name)),
        }))
    }

    /// The planar engine: the learned model's truth, several times slower.
    pub fn planar() -> Arc<dyn EffectModel> {
        Arc::new(Simulated::new(Simulator::planar()))
    }
}
