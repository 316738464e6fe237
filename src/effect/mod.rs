//! Effect models: prediction of the effect of a tool motion on a scene.
//!
//! Planner, benchmarks and trade-off depend only on [`EffectModel`]. The network, the analytic
//! model and the engines implement it at different speed and accuracy. This module contains no
//! search.

mod assuming;
mod build;
mod by_motion;
mod error;
mod lever;
mod measured;
mod model;
mod network;
mod prior;
mod routed;
mod simulated;
mod still;
mod trust;
mod up_to;

pub use crate::task::Job;
pub use assuming::{Assuming, shifted_start};
pub use build::EffectModels;
pub use by_motion::ByMotion;
pub use error::ModelError;
pub use lever::{
    LeverInputs, LeverNetwork, LeverNetworkError, LeverPrior, LeverView, PriorSettings,
    lever_action, lever_features, lever_inputs,
};
pub use measured::{PRIOR_RANGES, Quantiles};
pub use model::EffectModel;
pub use network::{Network, without_guesses};
pub use prior::Prior;
pub use routed::{Outside, Routed, consequence};
pub use simulated::Simulated;
pub use still::Still;
pub use trust::Trust;
pub use up_to::UpTo;
