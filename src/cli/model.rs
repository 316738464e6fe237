//! Effect models by name.

use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;

use clap::{Args, ValueEnum};

use crate::effect::{
    EffectModel, EffectModels, Follow, Guarded, Network, Outside, Prior, Projection, Simulated,
    Still,
};
use crate::network::{Weights, WeightsError};
use crate::sim::Simulator;
use crate::solve::Effort;

use super::error::CliError;

macro_rules! help {
    ($end:literal) => {
        concat!(
            "What predicts the effect of pushes: brdpn is the network; planar and 3d simulate; \
             quasi-static is the network's prior alone; projection, follow and still are trivial; \
             or a file of weights",
            $end
        )
    };
}

/// The line for `--help`.
pub const HELP: &str = help!("");

/// The same where the effort decides unless a model is named.
pub const HELP_WITH_EFFORT: &str = help!(" [default: that of the effort]");

/// The name of the model that is used unless another is asked for.
pub const DEFAULT: &str = "brdpn";

/// An effect model as asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ModelName {
    /// The shipped network.
    Brdpn,
    /// The network's quasi-static prior, without the network.
    Prior,
    /// The planar simulation.
    Planar,
    /// The 3-D simulation: slow.
    Spatial,
    /// Nothing moves.
    Still,
    /// What the tool touches moves along with it.
    Follow,
    /// Overlaps with the tool are removed, without physics.
    Projection,
    /// A network with these weights.
    Weights(PathBuf),
    /// That of the measured level which the effort stands for.
    OfEffort(Effort),
}

impl ModelName {
    /// Names of all but weights files.
    const NAMES: [(&'static str, ModelName); 7] = [
        ("brdpn", ModelName::Brdpn),
        ("planar", ModelName::Planar),
        ("3d", ModelName::Spatial),
        ("quasi-static", ModelName::Prior),
        ("projection", ModelName::Projection),
        ("follow", ModelName::Follow),
        ("still", ModelName::Still),
    ];

    /// Those that stand beside any other in `predict`.
    pub const SIMULATED: [ModelName; 2] = [ModelName::Planar, ModelName::Spatial];

    /// Those that stand beside any other in `evaluate`: what it must beat, and the other engine.
    pub const BASELINES: [ModelName; 5] = [
        ModelName::Spatial,
        ModelName::Prior,
        ModelName::Projection,
        ModelName::Follow,
        ModelName::Still,
    ];

    /// The model.
    ///
    /// # Errors
    /// A weights file that is missing, damaged or of someone else.
    pub fn load(&self) -> Result<Arc<dyn EffectModel>, CliError> {
        if let Self::OfEffort(effort) = self {
            return effort.model().map_err(broken);
        }
        if let Some(weights) = self.weights()? {
            return Ok(Arc::new(Network::new(weights)));
        }
        Ok(match self {
            Self::Planar => Arc::new(Simulated::new(Simulator::planar())),
            Self::Spatial => Arc::new(Simulated::new(Simulator::spatial())),
            Self::Still => Arc::new(Still),
            Self::Follow => Arc::new(Follow),
            Self::Projection => Arc::new(Projection),
            // Networks and efforts have returned above.
            Self::Prior | Self::Brdpn | Self::Weights(_) | Self::OfEffort(_) => {
                Arc::new(Prior::default())
            }
        })
    }

    /// The weights, for a network.
    ///
    /// # Errors
    /// A weights file that is missing, damaged or of someone else.
    pub fn weights(&self) -> Result<Option<Weights>, CliError> {
        match self {
            Self::Brdpn => EffectModels::weights().map(Some).map_err(broken),
            Self::OfEffort(effort) => {
                let network = Network::new(EffectModels::weights().map_err(broken)?);
                let same = effort.model().map_err(broken)?.name() == network.name();
                Ok(same.then(|| network.weights().clone()))
            }
            Self::Weights(path) => {
                let wrong = |why: String| CliError::File(format!("{}: {why}", path.display()));
                let bytes = std::fs::read(path)
                    .map_err(|error| wrong(format!("cannot read the file: {error}")))?;
                let weights =
                    Weights::from_bytes(&bytes).map_err(|error| wrong(error.to_string()))?;
                Ok(Some(weights))
            }
            _ => Ok(None),
        }
    }
}

fn broken(error: WeightsError) -> CliError {
    CliError::unexpected("the shipped weights are broken", &error)
}

impl FromStr for ModelName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((_, model)) = Self::NAMES.into_iter().find(|(name, _)| *name == text) {
            return Ok(model);
        }
        if text.ends_with(".safetensors") {
            return Ok(Self::Weights(PathBuf::from(text)));
        }
        let names: Vec<&str> = Self::NAMES.iter().map(|(name, _)| *name).collect();
        Err(format!("use {}, or a file that ends in .safetensors", names.join(", ")))
    }
}

/// What to do where the model should not be trusted.
#[derive(Args, Clone, Copy, Debug)]
pub struct OutsideArgs {
    /// What to do outside of what the model was trained on, or where its own prediction shows
    /// that it went wrong
    #[arg(long, value_enum, value_name = "WHAT", default_value_t)]
    outside: OutsideName,
}

impl OutsideArgs {
    /// What was asked for.
    pub fn outside(self) -> Outside {
        self.outside.into()
    }

    /// Notes what was asked for among the settings of a kept run, unless it is the default: a
    /// run that began without this option goes on.
    pub fn note(self, settings: &mut serde_json::Value) {
        if self.outside() != Outside::default() {
            settings["outside"] = serde_json::json!(self.outside());
        }
    }

    /// `model`, used only where it can be trusted.
    pub fn guard(self, model: Arc<dyn EffectModel>) -> Arc<dyn EffectModel> {
        match self.outside() {
            Outside::Warn => model,
            outside => Arc::new(Guarded::new(model, outside)),
        }
    }
}

/// [`Outside`] with words for `--help`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum OutsideName {
    /// Simulate in the plane instead
    Simulate,
    /// Predict and warn
    #[default]
    Warn,
    /// Give no prediction; exit code 6
    Refuse,
}

impl From<OutsideName> for Outside {
    fn from(name: OutsideName) -> Self {
        match name {
            OutsideName::Simulate => Outside::Simulate,
            OutsideName::Warn => Outside::Warn,
            OutsideName::Refuse => Outside::Refuse,
        }
    }
}
