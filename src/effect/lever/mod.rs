//! What a lever-up does to a plate, whoever computes it.
//!
//! [`LeverModel`] is to lever-ups what [`EffectModel`](super::EffectModel) is to pushes. A ladder
//! of speed and accuracy stands behind it. Nothing is searched here.

mod features;
mod model;
mod prior;
mod simulated;
mod view;

pub use features::{LeverFeatures, lever_action, lever_features};
pub use model::{LeverModel, LeverTrust};
pub use prior::{LeverPrior, PriorSettings};
pub use simulated::SimulatedLevers;
pub use view::LeverView;
