//! Training of the belief regulator on lessons, see [`crate::dataset::Lesson`].

mod batch;
mod score;
mod settings;
mod task;

pub use score::{RegulatorScore, score};
pub use settings::RegulatorSettings;
pub use task::train_regulator;
