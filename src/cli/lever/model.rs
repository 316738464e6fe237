//! Models of lever-ups on the command line.

use std::path::Path;
use std::sync::Arc;

use crate::cli::error::CliError;
use crate::effect::{LeverModel, LeverNetwork, LeverPrior, SimulatedLevers};
use crate::scene::{Engine, ModelKind, ModelSpec, Stride};
use crate::sim::LeverSimulator;

/// The model of lever-ups that `spec` describes, or else that which planning uses.
///
/// # Errors
/// [`CliError::Usage`] for models that know nothing of lever-ups.
pub fn lever_model(spec: Option<&ModelSpec>) -> Result<Arc<dyn LeverModel>, CliError> {
    let Some(spec) = spec else { return Ok(Arc::new(LeverPrior::default())) };
    let kind = &spec.first().kind;
    let plain = *spec == ModelSpec::of(kind.clone());
    match kind {
        _ if *spec == ModelSpec::of(ModelKind::PRIOR) => Ok(Arc::new(LeverPrior::default())),
        ModelKind::Network { weights, steps: None, stride: Stride::ONE } if plain => {
            lever_network(weights.as_ref().map(Path::new))
        }
        ModelKind::Simulated { engine: Engine::Spatial, rate } if spec.others().is_empty() => {
            Ok(Arc::new(SimulatedLevers { simulator: LeverSimulator { rate: *rate } }))
        }
        _ => Err(CliError::usage(
            format!("`{spec}` knows nothing of lever-ups"),
            "use prior, network or 3d, say 3d,step=1/60",
        )),
    }
}

/// The network of lever-ups with these weights, or else the shipped one.
///
/// # Errors
/// [`CliError::File`] for weights that cannot be used.
pub fn lever_network(weights: Option<&Path>) -> Result<Arc<dyn LeverModel>, CliError> {
    match weights {
        Some(path) => LeverNetwork::load(path)
            .map(|network| Arc::new(network) as _)
            .map_err(|error| CliError::File(error.to_string())),
        None => LeverNetwork::shipped()
            .map(|network| Arc::new(network) as _)
            .map_err(|error| CliError::unexpected("cannot use the shipped weights", &error)),
    }
}
