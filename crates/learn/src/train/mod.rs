//! Training: examples with noise, loss, optimiser, schedule, checkpoints and resumption.
//!
//! A run is a folder: `checkpoint.safetensors` (everything needed to resume bit-exactly),
//! `metrics.jsonl`, `best.safetensors`, the weights with the lowest held-out rollout error, and
//! `last.safetensors`, those of the last evaluation. Data come from `dataset`; nothing is
//! generated or drawn here.

mod checkpoint;
mod descent;
mod example;
mod gradients;
mod lever;
mod log;
mod loss;
mod metrics;
mod optimiser;
mod regulator;
mod rollout_error;
mod schedule;
mod settings;
mod trainer;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use descent::Descent;
pub use example::{Examples, Exposure, Noise};
pub use lever::{
    LeverCheckpoint, LeverLine, LeverScore, LeverSettings, PartsSettings, train_lever, train_parts,
};
pub use metrics::{HeldOutError, MetricLine};
pub use optimiser::AdamW;
pub use regulator::{
    RegulatorCheckpoint, RegulatorLine, RegulatorScore, RegulatorSettings, score, train_regulator,
};
pub use rollout_error::rollout_error;
pub use schedule::learning_rate;
pub use settings::Settings;
pub use trainer::{TrainError, train};
