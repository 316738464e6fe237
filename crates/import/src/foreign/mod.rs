//! Parts of files of other programs that several readers need: XML, URDF, meshes, and the files that a
//! file names.
//!
//! Mesh files are read by `stl_io` and `tobj`; MSH, an array of numbers, by itself.

mod files;
mod meshes;
pub mod urdf;
pub mod xml;

pub use files::{Files, Refused};
pub use meshes::load;
