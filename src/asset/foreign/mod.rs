//! What files of other programs name: files beside or below them, and meshes.
//!
//! Mesh files are read by `stl_io` and `tobj`; MSH, an array of numbers, by itself.

mod files;
mod meshes;

pub use files::{Files, Refused};
pub use meshes::load;
