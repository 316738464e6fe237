//! Data sets for other programs: NumPy's `.npz`, uncompressed zips of arrays.
//!
//! The same episodes as in [`generate`](super::generate()), [`A_FILE`] of them a file, with a line
//! for each file in `records.jsonl` and, when all are there, `statistics.json`. What the arrays hold
//! stands in [`FORMAT`], which is written beside them.

mod archive;
mod arrays;
mod statistics;
mod write;

pub use write::{A_FILE, generate_npz};

/// What the arrays of a file are: names, shapes, units.
pub const FORMAT: &str = include_str!("format.md");
