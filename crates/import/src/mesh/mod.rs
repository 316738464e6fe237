//! Meshes: STL, OBJ and MuJoCo's own MSH.
//!
//! A mesh counts by its convex hull, as in MuJoCo and Bullet, and weighs as much as it holds.

mod bulk;
mod read;
mod thing;

pub use bulk::{Counted, Mesh};
pub(super) use read::load;
pub(super) use thing::{language, model};
