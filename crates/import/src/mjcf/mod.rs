//! MJCF, the format of MuJoCo.
//!
//! Files are read as in MuJoCo: classes of defaults, angle unit and Euler sequence of the compiler,
//! frames, and masses from the densities of geoms if a body states none. Elements that need a
//! compiler (composites) are faults, with the advice to let MuJoCo expand them.

mod attach;
mod bodies;
mod compiler;
mod contacts;
mod defaults;
mod equality;
mod geoms;
mod meshes;
mod sections;

pub(super) use sections::model;
