//! Random lever-ups simulated in the 3-D engine.
//!
//! Every episode depends only on seed, family and index. Consecutive episodes lever the same shape
//! at different places. Shapes depend on the seed, so data sets of different seeds share none.

mod config;
mod drive;
mod episode;
mod lying;
mod plates;
mod preset;
mod split;

pub use config::{LEVER_SUITE, LeverConfig};
pub use episode::{LEVERS_PER_SHAPE, LeverEpisode, lever_job};
pub use preset::{DISC_PLACES, LeverPreset};
pub use split::LeverPart;
