//! How well joints are inferred from what is seen, and what that is worth: right types over time, how
//! sure beliefs are, and the error on the rest of the way under the belief at that moment.
//!
//! The sets are those of [`super::CrowdSet`], seen with several noises. The belief is compared with
//! what is known without looking (no joints, all contacts fixed), with the last window alone, and
//! with geometric residual tests.

mod circumstances;
mod follow;
mod record;
mod residual;
mod suite;
mod summary;

pub use circumstances::Circumstances;
pub use follow::{Asked, follow};
pub use record::{BeliefRecord, Checkpoint, JointMethod, Rest, When};
pub use suite::{BeliefCase, BeliefSuite, Sighting};
pub use summary::{
    BeliefStep, BeliefSummary, RestOfWay, Right, Sure, UpdateTimes, belief_steps,
    summarise_beliefs, update_times,
};
