//! Lever-ups in rapier3d in `f64`, gravity and table included.
//!
//! Plates are convex prisms cut into parts of at most four corners, because of a larger face parry
//! looks at four corners alone; cuboids stay whole. The table is a cuboid and feet are small balls.
//! The blade is kinematic and goes exactly where [`LeverUp::blade`](crate::task::LeverUp::blade)
//! says. Whatever is planned or judged, is so elsewhere.

mod fresh;
mod place;
mod play;
mod scenery;
mod simulator;
mod solids;
mod world;

pub use simulator::LeverSimulator;
