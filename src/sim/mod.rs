//! The simulator: rapier in two engines, planar (the default ground truth) and 3-D (the independent
//! check).
//!
//! [`Simulator::run`] plays a tool motion on a scene and records the result. This module plans and
//! judges nothing, and no type of rapier leaves it.
//!
//! Both engines support objects on the same points. Over 400 held-out pushes of one object, 20 cm
//! at 0.1 m/s, they end 0.96 mm apart (mean; cuboids 1.01) if nothing may tip (`pushplan-lab
//! evaluate 3d-upright --on single --pushes 400`). If objects may tip (`3d` for `3d-upright`), they
//! end 3.9 mm apart (cuboids 5.6), because the 3-D engine determines at which height two flat faces
//! press on each other.
//!
//! Objects with fixed joints between them are one body and hold exactly. The axes of rows of twelve
//! objects on revolute joints drift by up to 0.4 mm over a metre, pairs by hundredths
//! (`tests/it/simulation/joint_drift.rs`). Bodies that nothing has approached yet sleep: they cost
//! nothing and do not move.

mod asleep;
mod footprints;
mod groups;
mod joint_limits;
mod lever;
mod parameters;
mod planar;
mod playback;
mod seams;
mod simulator;
mod slowing;
mod solids;
mod solved;
mod spatial;
mod support;
mod upright;
mod violations;
mod world;

pub use lever::LeverSimulator;
pub use playback::Arm;
pub use simulator::Simulator;
