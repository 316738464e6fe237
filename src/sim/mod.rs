//! The simulator: rapier in two engines, planar (the default truth) and 3-D (the independent
//! check).
//!
//! [`Simulator::run`] plays a tool motion on a scene and records what happens. Nothing is
//! planned or judged here, and no type of rapier leaves this room.
//!
//! The engines differ by their support: even pressure in the planar one, corner points in 3-D.
//! Over 2000 held-out pushes of one object, 20 cm at 0.1 m/s, they end 4.4 mm apart for cylinders
//! (mean; median 1.9) and 17 mm for cuboids (median 10; `pushplan evaluate --model 3d`).
//!
//! Objects with fixed joints between them are one body and hold exactly; the axes of rows of
//! twelve objects on revolute joints drift by up to 0.4 mm over a metre, pairs by hundredths
//! (`tests/it/simulation/joint_drift.rs`).

mod drive;
mod groups;
mod parameters;
mod planar;
mod seams;
mod simulator;
mod solids;
mod spatial;
mod strain;
mod support;
mod upright;

pub use simulator::Simulator;
