//! Effect models by name.

use crate::effect::{EffectModel, Simulated};
use crate::sim::Simulator;

use super::error::CliError;

/// The models that `predict` compares: the network beside both simulations.
pub fn ladder() -> Result<Vec<Box<dyn EffectModel>>, CliError> {
    Ok(vec![
        Box::new(Simulated::new(Simulator::planar())),
        Box::new(Simulated::new(Simulator::spatial())),
    ])
}
