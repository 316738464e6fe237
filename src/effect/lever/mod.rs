//! What a lever-up does to a plate, whoever computes it.
//!
//! [`LeverModel`] is to lever-ups what [`EffectModel`](super::EffectModel) is to pushes. A ladder
//! of speed and accuracy stands behind it. Nothing is searched here.

mod model;
mod simulated;

pub use model::{LeverModel, LeverTrust};
pub use simulated::SimulatedLevers;
