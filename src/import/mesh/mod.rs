//! Meshes: STL, OBJ and MuJoCo's own MSH.
//!
//! A mesh counts by its convex hull, as in MuJoCo and Bullet, and weighs as much as it holds. Mesh files
//! are read by `stl_io` and `tobj`; MSH, an array of numbers, by itself.

mod bulk;
mod files;
mod thing;

pub use bulk::{Counted, Mesh};
pub(super) use files::load;
pub(super) use thing::{language, model};
