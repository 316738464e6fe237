//! Training loop, optimiser, schedule, checkpoints and log for all networks.
//!
//! A run is a folder with `checkpoint.safetensors` (the state for bit-exact resumption),
//! `metrics.jsonl`, `best.safetensors` (the weights with the best held-out score) and
//! `last.safetensors` (the weights of the last evaluation).
//!
//! A network implements [`Trainable`]; its examples, loss and score are in a folder of its own.
//! Data come from `dataset`. This module generates none.

mod checkpoint;
mod descent;
mod gradients;
mod lever;
mod log;
mod optimiser;
mod predictor;
mod regulator;
mod trainable;
mod trainer;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use descent::Descent;
pub use gradients::gradients_of;
pub use lever::{
    LeverBatch, LeverExample, LeverScore, LeverSettings, drawn, score as lever_score, train_lever,
};
pub use log::Line;
pub use optimiser::AdamW;
pub use predictor::{Examples, HeldOutError, PredictorSettings, rollout_error, train_predictor};
pub use regulator::{RegulatorScore, RegulatorSettings, score, train_regulator};
pub use trainable::Trainable;
pub use trainer::{BEST, LAST, REPLICAS, TrainError, Trainer};
