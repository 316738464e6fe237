//! Training data: random scenes and motions with their simulated effects.
//!
//! The ground truth of pushes with tools is from the 3-D engine in most episodes and from the 2-D
//! engine in the others, or from MuJoCo on request.
//!
//! Every episode depends only on the configuration's seed and its own index. Data are therefore
//! never committed but made again, in memory or in a resumable folder, bit-identical for any number
//! of threads.
//!
//! Scenes are tables with few objects pushed by tools (`tools`), or crowds of objects, some joined,
//! pushed by a round hand (`sparse`, `dense`). The shipped tools never occur. Lever-ups form
//! separate sets (`lever`). This module trains nothing.

mod aim;
mod assembly;
mod config;
mod constraints;
mod controlled;
mod crowd;
mod curriculum;
mod dense;
mod distributions;
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
pub use config::{DatasetConfig, SUITE};
pub use constraints::{Constraints, JointRule, TEST_SPEED};
pub use controlled::Controlled;
pub use distributions::log_uniform;
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
