//! rapier behind one door, in two engines: planar (the default truth) and 3-D (the independent
//! check).
//!
//! [`Simulator::run`] plays a tool motion on a scene and records what happens. Nothing is
//! planned or judged here, and no type of rapier leaves this room.

mod drive;
mod joints;
mod parameters;
mod planar;
mod simulator;
mod spatial;
mod support;

pub use simulator::Simulator;
