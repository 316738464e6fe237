//! Weights of networks of lever-ups, of any kind.

use std::path::Path;
use std::sync::Arc;

use pushplan::internals::effect::{LeverNetwork, LeverNetworkError};
use pushplan_learn::lever_model::LeverModel;

use crate::image::{ImageNetwork, ImageWeights};
use crate::parts::{LeverParts, PartsWeights};

/// Loads the weights of a network of lever-ups: the shipped kind, a network with image input, or a
/// network of parts.
///
/// # Errors
/// Returns [`LeverNetworkError`] if the weights cannot be used.
pub fn load_lever(path: &Path) -> Result<Arc<dyn LeverModel>, LeverNetworkError> {
    let named = |error| LeverNetworkError::Weights { path: path.display().to_string(), error };
    let bytes = std::fs::read(path).map_err(|error| named(error.into()))?;
    if PartsWeights::are_in(&bytes) {
        return Ok(Arc::new(LeverParts::new(&PartsWeights::from_bytes(&bytes).map_err(named)?)));
    }
    if ImageWeights::are_in(&bytes) {
        return Ok(Arc::new(ImageNetwork::new(&ImageWeights::from_bytes(&bytes).map_err(named)?)?));
    }
    Ok(Arc::new(LeverNetwork::load(path)?))
}
