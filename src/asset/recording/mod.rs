//! Recording files: the user's own data, a scene and the poses of all bodies frame by frame.
//!
#![doc = include_str!("format.md")]

mod emit;
mod frames;
mod load;
mod spec;
mod units;

pub(super) use spec::{RECORDING, RECORDING_KEYS};

/// The format in words, in Markdown.
pub const RECORDING_FORMAT: &str = include_str!("format.md");
