//! Data sets for other programs: NumPy's `.npz`, uncompressed zip files of arrays.
//!
//! Episodes equal the episodes of [`generate`](super::generate()), with [`A_FILE`] episodes per
//! file. Every file has a line in `records.jsonl`; `statistics.json` is written at the end. The
//! arrays are described in [`FORMAT`], which is written next to them.

mod archive;
mod arrays;
mod statistics;
mod write;

pub use write::{A_FILE, generate_npz};

/// Description of the arrays of a file: names, shapes, units.
pub const FORMAT: &str = include_str!("format.md");
