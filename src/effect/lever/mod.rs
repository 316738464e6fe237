//! What a lever-up does to a plate, whoever computes it.
//!
//! [`LeverModel`] is to lever-ups what [`EffectModel`](super::EffectModel) is to pushes. A ladder
//! of speed and accuracy stands behind it. Nothing is searched here.

mod model;
mod prior;
mod simulated;

pub use model::{LeverModel, LeverTrust};
pub use prior::{LeverPrior, PriorSettings};
pub use simulated::SimulatedLevers;
