//! Random lever-ups with what the 3-D engine says they do.
//!
//! Every episode is a pure function of seed, family and index. Neighbouring episodes lever the same
//! shape at other places; shapes depend on the seed, so data of another seed hold none of them.

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
