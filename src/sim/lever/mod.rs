//! Lever-ups in rapier3d in `f64`, with gravity and table.
//!
//! Plates are convex prisms divided into parts with at most four corners, because parry uses only
//! four corners of a larger face; cuboids stay whole. The table is a cuboid and feet are small
//! balls. The blade is kinematic and follows [`LeverUp::blade`](crate::task::LeverUp::blade)
//! exactly. Planning and judging are elsewhere.

mod fresh;
mod place;
mod play;
mod scenery;
mod simulator;
mod solids;
mod world;

pub use simulator::LeverSimulator;
