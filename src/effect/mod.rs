//! What a tool motion does to a scene, whatever computes it.
//!
//! Planner, benchmarks and trade-off see only [`EffectModel`]; the network, its prior and the engines
//! implement it, as rungs of one ladder of speed and accuracy. Nothing
//! is searched here.

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
