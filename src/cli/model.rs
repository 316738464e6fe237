//! Effect models by name.

use std::sync::Arc;

use clap::ValueEnum;

use crate::effect::{EffectModel, Simulated};
use crate::sim::Simulator;

use super::error::CliError;

/// The effect models that can be asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ModelName {
    /// The planar simulation
    #[default]
    Planar,
    /// The 3-D simulation: slow
    #[value(name = "3d")]
    Spatial,
}

impl ModelName {
    /// Those that `predict` compares.
    pub const LADDER: [ModelName; 2] = [ModelName::Planar, ModelName::Spatial];

    /// The model.
    ///
    /// # Errors
    /// [`CliError::Unexpected`] if the shipped weights are broken.
    pub fn load(self) -> Result<Arc<dyn EffectModel>, CliError> {
        Ok(match self {
            Self::Planar => Arc::new(Simulated::new(Simulator::planar())),
            Self::Spatial => Arc::new(Simulated::new(Simulator::spatial())),
        })
    }
}
