//! Levered bodies as graphs of cuboids, by a propagation network (Tekden 2020, section 8.5).
//!
//! Every cuboid of the levered body is a node, joined to its first one; table, blocks and blade send to those
//! that they are near. The network says how the body moves in a step, or by how much otherwise than the
//! prior, and is asked again where that leads, over the turn and on to rest. Everything is seen in the lever
//! frame, and the network treats both sides of it alike, so moved, turned and mirrored lever-ups have
//! moved, turned and mirrored answers.

mod bodies;
mod clock;
mod course;
mod describe;
mod graphs;
mod model;
mod state;
mod walk;

pub use course::LeverCourse;
pub use graphs::PartGraphs;
pub use model::LeverParts;
pub use state::PartState;
pub use walk::{Walk, Walker};
