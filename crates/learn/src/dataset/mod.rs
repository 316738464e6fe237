//! Training data: random scenes and pushes with what an engine says they do: the 3-D one for most
//! of those with tools, the planar one for the others, or MuJoCo where it is asked for.
//!
//! Every episode is a pure function of the configuration's seed and its own index, so data are
//! never committed but made again, in memory or in a folder, resumable, with the same
//! bits for any number of threads. Either tools on tables with few objects (`tools`), or crowds of
//! objects, some joined, pushed by a round hand (`sparse`, `dense`). The shipped tools never occur
//! in it. Lever-ups are sets of their own (`lever`). Trains nothing.

mod aim;
mod assembly;
mod chance;
mod config;
mod constraints;
mod controlled;
mod crowd;
mod curriculum;
mod dense;
mod episode;
mod error;
mod generate;
mod hand;
mod heavy;
mod jam;
mod joints;
mod lesson;
mod lessons;
mod lever;
mod mujoco;
mod novelty;
mod npz;
mod observed;
mod obstacle;
mod preset;
mod set;
mod sparse;
mod tabletop;
mod tools;
mod truth;
mod unseen;

pub use aim::{Aim, SET_DOWN, aimed_stroke, random_direction, random_heading};
pub use assembly::random_tool;
pub use chance::log_uniform;
pub use config::{DatasetConfig, SUITE};
pub use constraints::{Constraints, JointRule, TEST_SPEED};
pub use controlled::Controlled;
pub use episode::Episode;
pub use error::DatasetError;
pub use generate::{generate, merge_data};
pub use hand::HAND_RADIUS;
pub use heavy::{MASS_RANGES, MassEpisode, MassSetup, Touched};
pub use lesson::{Lesson, moved, true_type};
pub use lessons::lessons;
pub use lever::{
    DISC_PLACES, LEVER_SUITE, LEVERS_PER_SHAPE, LeverConfig, LeverEpisode, LeverPart, LeverPreset,
    lever_job,
};
pub use novelty::is_shipped;
pub use npz::{A_FILE, FORMAT as NPZ_FORMAT, generate_npz};
pub use observed::Seeing;
pub use preset::Preset;
pub use set::{Dataset, LeverDataset, Sampler, Set};
pub use tabletop::{Crowd, Solids, anywhere, random_scene};
pub use truth::Truth;

pub use pushplan::internals::scene::{Ranges, Span};
