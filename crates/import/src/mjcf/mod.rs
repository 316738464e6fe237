//! MJCF, the files of MuJoCo.
//!
//! Read as MuJoCo reads them: classes of defaults, angles and Euler letters of the compiler, frames,
//! masses of geoms from densities where a body states none. What a program would have to compute
//! first (`replicate`, composites) is a fault that says how to have MuJoCo do it.

mod attach;
mod bodies;
mod compiler;
mod contacts;
mod defaults;
mod geoms;
mod meshes;
mod sections;

pub(super) use sections::model;
