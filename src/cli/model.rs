//! Effect models by name.

use std::sync::Arc;

use clap::ValueEnum;

use crate::effect::{EffectModel, Follow, Projection, Simulated, Still};
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
    /// Nothing moves
    Still,
    /// What the tool touches moves along with it
    Follow,
    /// Overlaps with the tool are removed, without physics
    Projection,
}

impl ModelName {
    /// Those that `predict` compares.
    pub const LADDER: [ModelName; 2] = [ModelName::Planar, ModelName::Spatial];

    /// Those whose errors `evaluate` measures.
    pub const MEASURED: [ModelName; 4] =
        [ModelName::Spatial, ModelName::Still, ModelName::Follow, ModelName::Projection];

    /// The model.
    ///
    /// # Errors
    /// [`CliError::Unexpected`] if the shipped weights are broken.
    pub fn load(self) -> Result<Arc<dyn EffectModel>, CliError> {
        Ok(match self {
            Self::Planar => Arc::new(Simulated::new(Simulator::planar())),
            Self::Spatial => Arc::new(Simulated::new(Simulator::spatial())),
            Self::Still => Arc::new(Still),
            Self::Follow => Arc::new(Follow),
            Self::Projection => Arc::new(Projection),
        })
    }
}
