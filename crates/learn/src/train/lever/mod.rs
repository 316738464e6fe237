//! Training of networks of lever-ups on episodes, see [`crate::dataset::LeverEpisode`].
//!
//! A run is a folder as that of the physics predictor.

mod autoencoder;
mod batch;
mod checkpoint;
mod parts;
mod replicas;
mod settings;
mod trainer;

pub use checkpoint::LeverCheckpoint;
pub use parts::{PartsSettings, train_parts};
pub use settings::{LeverLine, LeverScore, LeverSettings};
pub use trainer::train_lever;
