//! Effect models of lever-ups.
//!
//! The analytic model and the network predict one object during one lever-up; both are an
//! [`EffectModel`](super::EffectModel) that declines every other motion.

mod courses;
mod features;
mod inputs;
mod network;
mod prior;
mod view;

pub use features::{lever_action, lever_features};
pub use inputs::{LeverInputs, lever_inputs};
pub use network::{LeverNetwork, LeverNetworkError};
pub use prior::{LeverPrior, PriorSettings};
pub use view::LeverView;
