//! The waist of the house: what a tool motion does to a scene, whoever computes it.
//!
//! Planner, benchmarks and trade-off see only [`EffectModel`]; learned, simulated and trivial
//! models stand behind it as levels of one speed-accuracy ladder. Nothing is searched here.

mod assume;
mod crowded;
mod disturbed;
mod model;
mod network;
mod outside;
mod prior;
mod shipped;
mod simulated;
mod trivial;

pub use crate::scene::Job;
pub use assume::{Assuming, Assumption};
pub use crowded::Crowded;
pub use disturbed::{Disturbed, Mistake, shifted_start};
pub use model::EffectModel;
pub use network::Network;
pub use outside::{Guarded, Outside, consequence};
pub use prior::Prior;
pub use shipped::EffectModels;
pub use simulated::Simulated;
pub use trivial::{Follow, Projection, Still};
