//! Training of the network of parts, step by step on recorded lever-ups.
//!
//! Half of the examples begin where the truth is, disturbed, half where a rollout of the network itself has
//! come to: both ask for the step back to the truth, which keeps rollouts near it (Sanchez-Gonzalez et al.,
//! ICML 2020; Ross, Gordon and Bagnell, AISTATS 2011).

mod checkpoint;
mod examples;
mod settings;
mod trainer;

pub use settings::PartsSettings;
pub use trainer::train_parts;
