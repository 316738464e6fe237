//! What a lever-up does to a plate, whoever computes it.
//!
//! A [`LeverModel`] follows one object through one lever-up; [`Levering`] makes an
//! [`EffectModel`](super::EffectModel) of it and of one that knows pushes. A ladder of speed and
//! accuracy stands behind it. Nothing is searched here.

mod features;
mod inputs;
mod levering;
mod model;
mod network;
mod prior;
mod simulated;
mod view;

pub use features::{lever_action, lever_features};
pub use inputs::{LeverInputs, lever_inputs};
pub use levering::Levering;
pub use model::{LeverModel, LeverTrust};
pub use network::{LeverNetwork, LeverNetworkError};
pub use prior::{LeverPrior, PriorSettings};
pub use simulated::SimulatedLevers;
pub use view::LeverView;
