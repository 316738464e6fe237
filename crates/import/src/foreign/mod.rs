//! Shared parts of the readers of other formats: XML, URDF, meshes, and the files that a file
//! names.
//!
//! Mesh files are read with `stl_io` and `tobj`; MSH, an array of numbers, is read directly.

mod files;
mod meshes;
pub mod urdf;
pub mod xml;

pub use files::{Files, Refused};
pub use meshes::load;
