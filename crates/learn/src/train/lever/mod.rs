//! Training of networks of lever-ups on episodes, see [`crate::dataset::LeverEpisode`].

mod batch;
mod settings;
mod task;

pub use batch::{LeverBatch, LeverExample};
pub use settings::{LeverScore, LeverSettings};
pub use task::{drawn, score, train_lever};
