//! Effect models on the command line.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;

use pushplan::effect::{EffectModel, EffectModels, ModelError, Outside, Routed};
use pushplan::network::PredictorWeights;
use pushplan::scene::{ModelSpec, OTHER_OBJECTS, Scene, TableFit};
use pushplan_report::Setting;

use super::error::CliError;
use super::session::Session;
use super::words::{OUTSIDE, words};

macro_rules! help {
    ($end:literal) => {
        concat!(
            "What predicts the effect of pushes: network; prior (the network's prior alone); \
             planar or 3d (simulations); still (nothing moves); or a file of weights. Settings stand behind commas: prior,frame=20mm or planar,step=1/120; a \
             bar says which model takes over: prior,up-to=2|planar",
            $end
        )
    };
}

/// The line for `--help`.
pub const HELP: &str = help!("");

/// The same where the effort decides unless models are named.
pub const HELP_WITH_EFFORT: &str = help!(
    ". Two with > between them: the first screens the many rollouts of a search, the second decides \
     among the few, prior>network [default: those of the effort]"
);

/// The same where it is the network unless a model is named; for lever-ups their own.
pub const HELP_WITH_NETWORK: &str = help!(" [default: network]");

/// Models of lever-ups.
pub const HELP_FOR_LEVERS: &str =
    "What predicts the effect of lever-ups: prior, or a simulation such as 3d,step=1/60";

/// The model that is used unless another is asked for.
pub const DEFAULT: &str = "network";

/// The model that `spec` describes.
///
/// # Errors
/// A weights file that is missing, damaged or not of pushplan.
pub fn load(spec: &ModelSpec) -> Result<Routed, CliError> {
    Ok(EffectModels::build(spec)?)
}

/// The weights of a network; none for other models.
///
/// # Errors
/// A weights file that is missing, damaged or not of pushplan.
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

/// What was learnt about the table.
#[derive(Args, Clone, Debug)]
pub struct TableArgs {
    /// What `pushplan fit --save-fit FILE` learnt about this table
    #[arg(long, value_name = "FILE")]
    fit: Option<PathBuf>,
}

impl TableArgs {
    /// The file, if one is named.
    pub fn setting(&self) -> Option<Setting> {
        let value = self.fit.as_ref()?.display().to_string();
        Some(Setting { option: "--fit", keyword: Some("fit"), value })
    }

    /// The file's contents, if one is named.
    ///
    /// # Errors
    /// A file that cannot be read, or is none of a fit.
    pub fn load(&self) -> Result<Option<TableFit>, CliError> {
        Ok(self.fit.as_ref().map(TableFit::load).transpose()?)
    }
}

/// Lets `scene` be as `fit` says, and warns of objects that it was not learnt on.
pub fn state(fit: &TableFit, scene: &mut Scene, session: &Session) {
    for object in fit.strange(scene) {
        session.warn(&format!(
            "the fit was learnt on other objects than `{object}`: what it changes in the network \
             counts by {:.0} % here",
            100.0 * OTHER_OBJECTS
        ));
    }
    fit.state(scene);
}

/// What to do where the model should not be trusted.
#[derive(Args, Clone, Copy, Debug)]
pub struct OutsideArgs {
    /// What to do outside of a model's ranges, or where its own prediction shows that it went wrong
    #[arg(long, value_parser = words(&OUTSIDE), value_name = "WHAT", default_value = "warn")]
    outside: Outside,
}

impl OutsideArgs {
    /// What was asked for.
    pub fn outside(self) -> Outside {
        self.outside
    }

    /// Notes what was asked for among the settings of a kept run, unless it is the default: a
    /// run that began without this option goes on.
    pub fn note(self, settings: &mut serde_json::Value) {
        if self.outside() != Outside::default() {
            settings["outside"] = serde_json::json!(self.outside());
        }
    }

    /// The model that `spec` describes, used only where it can be trusted.
    ///
    /// # Errors
    /// Those of [`load`].
    pub fn load(self, spec: &ModelSpec) -> Result<Arc<dyn EffectModel>, CliError> {
        self.fitted(spec, None)
    }

    /// The same with what was learnt about a table.
    ///
    /// # Errors
    /// Those of [`load`], and a fit of other weights.
    pub fn fitted(
        self,
        spec: &ModelSpec,
        fit: Option<&TableFit>,
    ) -> Result<Arc<dyn EffectModel>, CliError> {
        Ok(Arc::new(EffectModels::fitted(spec, fit)?.outside(self.outside())))
    }
}
