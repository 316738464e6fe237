//! Levered bodies as graphs of cuboids, by a propagation network (Tekden 2020, section 8.5).
//!
//! Every cuboid of the levered body is a node, joined to its first one; table, blocks and blade send to those
//! that they are near. The network says how the body moves in a step, or by how much otherwise than the
//! prior, and is asked again where that leads, over the turn and on to rest. Everything is seen in the lever
//! frame, and the network treats both sides of it alike, so moved, turned and mirrored lever-ups have
//! moved, turned and mirrored answers.
//!
//! It learns step by step from recorded lever-ups. Half of the examples begin where the truth is, disturbed,
//! half where a rollout of the network itself has come to: both ask for the step back to the truth, which
//! keeps rollouts near it (Sanchez-Gonzalez et al., ICML 2020; Ross, Gordon and Bagnell, AISTATS 2011).
//!
//! Tried and lost: it finds the same points as the prior, for most of its cost, and is no more exact
//! (`crates/models/lever.md`, boards in drives).

mod bodies;
mod card;
mod clock;
mod course;
mod describe;
mod examples;
mod graphs;
mod model;
mod settings;
mod state;
mod train;
mod walk;

pub use card::{PARTS, PartsCard, PartsWeights};
pub use course::LeverCourse;
pub use graphs::PartGraphs;
pub use model::LeverParts;
pub use settings::PartsSettings;
pub use state::PartState;
pub use train::train_parts;
pub use walk::{Walk, Walker};
