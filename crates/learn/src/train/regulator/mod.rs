//! Training of the belief regulator on lessons, see [`crate::dataset::Lesson`].
//!
//! A run is a folder as that of the physics predictor; the lessons lie in its folder `lessons`.

mod batch;
mod checkpoint;
mod score;
mod settings;
mod trainer;

pub use checkpoint::RegulatorCheckpoint;
pub use score::{RegulatorLine, RegulatorScore, score};
pub use settings::RegulatorSettings;
pub use trainer::train_regulator;
