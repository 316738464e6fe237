//! Common arguments of all benchmarks.

use std::sync::Arc;

use clap::Args;

use crate::{
    action::LibraryArgs,
    error::CliError,
    model::{self, OutOfRangeArgs},
};
use pushplan::effect::EffectModel;
use pushplan::scene::{ModelKind, ModelSpec};
use pushplan::solve::{Effort, Planner, PlannerBuilder};

/// Arguments of every benchmark.
#[derive(Args, Debug)]
pub struct Common {
    #[arg(long, value_name = "MODEL", help = model::HELP_WITH_EFFORT)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    pub out_of_range: OutOfRangeArgs,
    #[command(flatten)]
    pub library: LibraryArgs,
}

impl Common {
    /// Returns the given model, otherwise the model of the effort.
    pub fn model(&self, effort: Effort) -> ModelSpec {
        self.model.clone().unwrap_or_else(|| effort.model())
    }

    /// Loads the given model, otherwise the network, used only within its range.
    ///
    /// # Errors
    /// Returns the errors of [`model::load`].
    pub fn load_model(&self) -> Result<Arc<dyn EffectModel>, CliError> {
        self.out_of_range.load(&self.model_or_network())
    }

    /// Returns a planner with the given model, otherwise with the model of the effort.
    ///
    /// # Errors
    /// Returns an error if the weights cannot be used.
    pub fn planner(&self, effort: Effort) -> Result<PlannerBuilder, CliError> {
        let planner = Planner::with_model(&self.model(effort))?;
        Ok(planner.effort(effort).out_of_range(self.out_of_range.out_of_range()))
    }

    /// Returns the given model, otherwise the network, for commands that do not plan.
    pub fn model_or_network(&self) -> ModelSpec {
        self.model.clone().unwrap_or_else(|| ModelKind::NETWORK.into())
    }
}
