//! Effect models on the command line.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;

use pushplan::effect::{EffectModel, EffectModels, Fallback, ModelError, OutOfRange};
use pushplan::network::PredictorWeights;
use pushplan::scene::{ModelSpec, OTHER_OBJECTS, Scene, TableFit};
use pushplan_report::Setting;

use super::error::CliError;
use super::session::Session;
use super::value_enums::{OUT_OF_RANGE, possible_values};

macro_rules! help {
    ($end:literal) => {
        concat!(
            "Effect model of pushes: network; prior (the analytic model that it corrects); planar \
             or 3d (2-D or 3-D simulation); still (nothing moves); or a weights file. Settings \
             follow commas: prior,frame=20mm or planar,step=1/120. A bar precedes the fallback \
             model: prior,up-to=2|planar",
            $end
        )
    };
}

/// Text of `--help`.
pub const HELP: &str = help!("");

/// Text of `--help` for commands whose default models depend on the effort.
pub const HELP_WITH_EFFORT: &str =
    help!(" [default: network; planar,step=1/60 for pushes of ten and more objects]");

/// Text of `--help` for commands whose default is the network; lever-ups have their own text.
pub const HELP_WITH_NETWORK: &str = help!(" [default: network]");

/// Text of `--help` for models of lever-ups.
pub const HELP_FOR_LEVERS: &str =
    "Effect model of lever-ups: prior (analytic model), or a simulation such as 3d,step=1/60";

/// Default model.
pub const DEFAULT: &str = "network";

/// Loads the model that `spec` describes.
///
/// # Errors
/// Returns an error if a weights file is missing, damaged or of another program.
pub fn load(spec: &ModelSpec) -> Result<Fallback, CliError> {
    Ok(EffectModels::build(spec)?)
}

/// Loads the weights of a network; returns `None` for other models.
///
/// # Errors
/// Returns an error if a weights file is missing, damaged or of another program.
pub fn weights(spec: &ModelSpec) -> Result<Option<PredictorWeights>, CliError> {
    Ok(EffectModels::weights_of(spec)?)
}

impl From<ModelError> for CliError {
    fn from(error: ModelError) -> Self {
        match &error {
            ModelError::Shipped(_) => Self::Unexpected(error.to_string()),
            ModelError::File { .. } | ModelError::Fit { .. } | ModelError::Custom(_) => {
                Self::File(error.to_string())
            }
        }
    }
}

/// Table fit.
#[derive(Args, Clone, Debug)]
pub struct TableArgs {
    /// Table fit, written by `pushplan fit --save-fit FILE`
    #[arg(long, value_name = "FILE")]
    fit: Option<PathBuf>,
}

impl TableArgs {
    /// Returns the file as a setting, if one is named.
    pub fn setting(&self) -> Option<Setting> {
        let value = self.fit.as_ref()?.display().to_string();
        Some(Setting { option: "--fit", keyword: Some("fit"), value })
    }

    /// Reads the file, if one is named.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read, or is not a fit.
    pub fn load(&self) -> Result<Option<TableFit>, CliError> {
        Ok(self.fit.as_ref().map(TableFit::load).transpose()?)
    }
}

/// Applies `fit` to `scene`, with a warning for objects that were not in its training data.
pub fn state(fit: &TableFit, scene: &mut Scene, session: &Session) {
    for object in fit.strange(scene) {
        session.warn(&format!(
            "the table fit was learned on other objects than `{object}`, so its correction of the \
             network is scaled to {:.0} %",
            100.0 * OTHER_OBJECTS
        ));
    }
    fit.state(scene);
}

/// Policy outside of a model's range.
#[derive(Args, Clone, Copy, Debug)]
pub struct OutOfRangeArgs {
    /// Policy outside of a model's ranges, and for predictions that are evidently wrong
    #[arg(long, value_parser = possible_values(&OUT_OF_RANGE),
          value_name = "WHAT", default_value = "warn")]
    out_of_range: OutOfRange,
}

impl OutOfRangeArgs {
    /// Returns the policy outside of a model's range.
    pub fn out_of_range(self) -> OutOfRange {
        self.out_of_range
    }

    /// Adds the policy to the settings of a saved run, unless it is the default. Runs started
    /// before this option existed can therefore be resumed.
    pub fn note(self, settings: &mut serde_json::Value) {
        if self.out_of_range() != OutOfRange::default() {
            settings["out_of_range"] = serde_json::json!(self.out_of_range());
        }
    }

    /// Loads the model that `spec` describes, used only within its range.
    ///
    /// # Errors
    /// Returns the errors of [`load`].
    pub fn load(self, spec: &ModelSpec) -> Result<Arc<dyn EffectModel>, CliError> {
        self.fitted(spec, None)
    }

    /// Loads the model with a table fit.
    ///
    /// # Errors
    /// Returns the errors of [`load`], and an error for a fit of other weights.
    pub fn fitted(
        self,
        spec: &ModelSpec,
        fit: Option<&TableFit>,
    ) -> Result<Arc<dyn EffectModel>, CliError> {
        Ok(Arc::new(EffectModels::fitted(spec, fit)?.out_of_range(self.out_of_range())))
    }
}
