//! Training of the physics predictor on single frames of episodes, see [`crate::dataset::Episode`].

mod doubt;
mod example;
mod loss;
mod rollout_error;
mod settings;
mod share;
mod task;

pub use example::{Examples, Exposure, Noise};
pub use rollout_error::{HeldOutError, rollout_error};
pub use settings::PredictorSettings;
pub use task::train_predictor;
