//! What every benchmark takes.

use std::sync::Arc;

use clap::Args;

use crate::{
    action::LibraryArgs,
    error::CliError,
    model::{self, OutsideArgs},
};
use pushplan::effect::EffectModel;
use pushplan::scene::{ModelKind, ModelSpec, Models};
use pushplan::solve::{Effort, Planner, PlannerBuilder};

/// What every benchmark takes.
#[derive(Args, Debug)]
pub struct Common {
    #[arg(long, value_name = "MODEL", help = model::HELP_WITH_EFFORT)]
    model: Option<Models>,
    #[command(flatten)]
    pub outside: OutsideArgs,
    #[command(flatten)]
    pub library: LibraryArgs,
}

impl Common {
    /// The models that are asked for, or else those of the effort.
    pub fn models(&self, effort: Effort) -> Models {
        self.model.clone().unwrap_or_else(|| effort.models())
    }

    /// The model that is asked for, or else the network, used only where it can be trusted.
    ///
    /// # Errors
    /// Those of [`model::load`].
    pub fn load_model(&self) -> Result<Arc<dyn EffectModel>, CliError> {
        self.outside.load(&self.model_or_network())
    }

    /// A planner with the models that are asked for, or else those of the effort.
    ///
    /// # Errors
    /// Weights that cannot be used.
    pub fn planner(&self, effort: Effort) -> Result<PlannerBuilder, CliError> {
        let planner = Planner::with_models(&self.models(effort))?;
        Ok(planner.effort(effort).outside(self.outside.outside()))
    }

    /// The model that is asked for, or else the network: where nothing is planned.
    pub fn model_or_network(&self) -> ModelSpec {
        self.model.clone().map_or(ModelKind::NETWORK.into(), |models| models.decided)
    }
}
