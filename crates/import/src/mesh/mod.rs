//! Meshes: STL, OBJ, DAE and MuJoCo's own MSH.
//!
//! A mesh collides as its convex hull, as in MuJoCo and Bullet; its mass follows from its volume.

mod bulk;
mod read;
mod thing;

pub use bulk::{Counted, Mesh};
pub(super) use read::load;
pub(super) use thing::{language, model};
