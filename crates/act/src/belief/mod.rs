//! Belief about the objects of a scene: joints between them and their geometry, from observed
//! motion.
//!
//! The filter keeps hypotheses for every pair of near objects. [`Belief::update`] rolls out the
//! tool's motion under every joint type of every pair that moved. It compares the observations with
//! each rollout in joint coordinates (`fit`): held coordinates with their estimate, free ones with
//! the rollout.
//!
//! An unobserved heading is the rolled-out heading plus an error that every hypothesis estimates
//! with its geometry. The evidence then depends on the motion of the whole group. A window is
//! therefore evaluated twice, the second time with the joints that it supports. After a push, whole
//! assignments of joints are replayed and compared (`group`).
//!
//! A joint that stays in place although a rollout continues has reached a limit, which is learned
//! (`joint_limits`). Predictions are medians over sampled physics (`prediction`).
//!
//! A [`BeliefRegulator`] may correct the filter: a recurrent network on features of every window
//! and pair (`regulator_features`).
//!
//! Unknown masses, frictions and supports are represented by particles, weighed after every push
//! under the most probable joints. Masses in a few separate ranges are handled by `masses`.

mod density;
mod distributions;
mod filter;
mod fit;
mod from_task;
mod group;
mod importance;
mod joint_limits;
mod joints;
mod masses;
mod median;
mod pair;
mod pair_likelihood;
mod particles;
mod prediction;
mod regulation;
mod regulator_features;
mod relative;
mod rolled;
mod sample;
mod settings;
mod state_filter;
mod window;

pub use distributions::{generator, normal, weighted};
pub use filter::{Belief, Step};
pub use joint_limits::NO_STOP;
pub use joints::carried;
pub use masses::{MassRatio, MassShares};
pub use pair::JointType;
pub use particles::Numbers;
pub use regulation::{BeliefRegulator, RegulatorError};
pub use regulator_features::{Draft, EVIDENCE, RegulatorFeatures};
pub use settings::BeliefSettings;
