//! Levered bodies as graphs of cuboids, by a propagation network (Tekden 2020, section 8.5).
//!
//! Every cuboid of the levered body is a node, joined to the first cuboid. Table, blocks and blade
//! send to the cuboids near them. The network predicts the motion of the body in a step, or the
//! correction of the analytic model, and is applied step by step through the rotation until rest.
//! Features are in the lever frame, and the network treats both of its sides alike. Lever-ups that
//! are moved, rotated or mirrored therefore have moved, rotated or mirrored answers.
//!
//! The network is trained step by step on recorded lever-ups. Half of the examples begin at the
//! perturbed ground truth, half at a state of the network's own rollout. The target of both is the
//! step back to the ground truth, which keeps rollouts near it (Sanchez-Gonzalez et al., ICML 2020;
//! Ross, Gordon and Bagnell, AISTATS 2011).
//!
//! Rejected: it finds the same points as the analytic model, for most of its cost, and is no more
//! accurate (`crates/models/lever.md`, boards in drives).

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
