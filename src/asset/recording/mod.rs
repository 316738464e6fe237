//! Recording files: the user's own data, given as a scene and the poses of all bodies in every
//! frame.
//!
#![doc = include_str!("format.md")]

mod emit;
mod frames;
mod load;
mod spec;
mod units;

pub(super) use spec::{RECORDING, RECORDING_KEYS};

/// Description of the format, in Markdown.
pub const RECORDING_FORMAT: &str = include_str!("format.md");
