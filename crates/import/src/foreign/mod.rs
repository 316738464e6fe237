//! Shared parts of the readers of other formats: XML, URDF, meshes, and the files that a file
//! names.
//!
//! Mesh files are read with `stl_io` and `tobj`; DAE and MSH are read directly. (`mesh-loader` 0.1
//! panics on damaged DAE files, and shows a geometry only once.)

mod dae;
mod files;
mod meshes;
pub mod urdf;
pub mod xml;

pub use files::{Files, Refused};
pub use meshes::load;
