//! Accuracy of joints inferred from observations, and their value for prediction: right types over
//! time, calibration, and the error of the remaining motion under the belief at that moment.
//!
//! The scenes are [`super::CrowdSet`] sets, observed with several noises. Baselines of the belief
//! are assumptions without observations (no joints, all contacts fixed), the last window alone, and
//! geometric residual tests.

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
