//! Training of the physics predictor on whole pushes, see [`crate::dataset::Episode`].

mod doubt;
mod example;
mod loss;
mod rollout_error;
mod settings;
mod share;
mod task;

pub use example::Examples;
pub use rollout_error::{HeldOutError, rollout_error};
pub use settings::PredictorSettings;
pub use task::train_predictor;
