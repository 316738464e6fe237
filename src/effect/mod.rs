//! Effect models: prediction of the effect of a tool motion on a scene.
//!
//! Planner, benchmarks and trade-off depend only on [`EffectModel`]. The network, the analytic
//! model and the engines implement it at different speed and accuracy. This module contains no
//! search.

mod assuming;
mod build;
mod by_motion;
mod crowd_limit;
mod error;
mod fallback;
mod lever;
mod measured;
mod model;
mod network;
mod prior;
mod simulated;
mod still;
mod trust;

pub use crate::task::Job;
pub use assuming::{Assuming, shifted_start};
pub use build::EffectModels;
pub use by_motion::ByMotion;
pub use crowd_limit::CrowdLimit;
pub use error::ModelError;
pub use fallback::{Fallback, OutOfRange, consequence};
pub use lever::{
    LeverInputs, LeverNetwork, LeverNetworkError, LeverPrior, LeverView, PriorSettings,
    lever_action, lever_features, lever_inputs,
};
pub use measured::{PRIOR_RANGES, Quantiles};
pub use model::EffectModel;
pub use network::{Network, without_guesses};
pub use prior::Prior;
pub use simulated::Simulated;
pub use still::Still;
pub use trust::Trust;
