//! What a lever-up does to a plate, whoever computes it.
//!
//! [`LeverModel`] is to lever-ups what [`EffectModel`](super::EffectModel) is to pushes. A ladder
//! of speed and accuracy stands behind it. Nothing is searched here.

mod features;
mod inputs;
mod model;
mod network;
mod prior;
mod simulated;
mod view;

pub use features::{lever_action, lever_features};
pub use inputs::{LeverInputs, lever_inputs};
pub use model::{LeverModel, LeverTrust};
pub use network::{LeverNetwork, LeverNetworkError};
pub use prior::{LeverPrior, PriorSettings};
pub use simulated::SimulatedLevers;
pub use view::LeverView;
