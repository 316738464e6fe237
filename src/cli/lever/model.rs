//! Models of lever-ups on the command line.

use std::sync::Arc;

use crate::cli::error::CliError;
use crate::effect::{LeverModel, LeverPrior, SimulatedLevers};
use crate::scene::{Engine, ModelKind, ModelSpec};
use crate::sim::LeverSimulator;

/// The model of lever-ups that `spec` describes, or else that which planning uses.
///
/// # Errors
/// [`CliError::Usage`] for models that know nothing of lever-ups.
pub fn lever_model(spec: Option<&ModelSpec>) -> Result<Arc<dyn LeverModel>, CliError> {
    let Some(spec) = spec else { return Ok(Arc::new(LeverPrior::default())) };
    match spec.first().kind {
        _ if *spec == ModelSpec::of(ModelKind::PRIOR) => Ok(Arc::new(LeverPrior::default())),
        ModelKind::Simulated { engine: Engine::Spatial, rate } if spec.others().is_empty() => {
            Ok(Arc::new(SimulatedLevers { simulator: LeverSimulator { rate } }))
        }
        _ => Err(CliError::usage(
            format!("`{spec}` knows nothing of lever-ups"),
            "use prior or 3d, say 3d,step=1/60",
        )),
    }
}
