//! Shared parts of the readers of other formats: XML, URDF, meshes, and the files that a file
//! names.
//!
//! Polygons of mesh files are cut into triangles by `earcut`.

mod files;
mod meshes;
pub mod urdf;
pub mod xml;

pub use files::{Files, Refused};
pub use meshes::load;
pub(crate) use meshes::load_upright;
