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
//! A joint that stays in place although a rollout continues has reached a limit, which is learnt
//! (`stops`). Predictions are medians over sampled physics (`foreseen`).
//!
//! A [`BeliefRegulator`] may correct the filter: a recurrent network on features of every window
//! and pair (`testimony`).
//!
//! Unknown masses, frictions and supports are represented by particles, weighed after every push
//! under the most probable joints. Masses in a few separate ranges are handled by `masses`.

mod about;
mod chance;
mod density;
mod filter;
mod fit;
mod foreseen;
mod group;
mod joints;
mod look;
mod masses;
mod median;
mod pair;
mod particles;
mod regulation;
mod relative;
mod rolled;
mod sample;
mod settings;
mod stops;
mod testimony;
mod track;
mod weighing;
mod window;

pub use chance::{generator, normal};
pub use filter::{Belief, Step};
pub use joints::carried;
pub use masses::{MassRatio, MassShares};
pub use pair::JointType;
pub use particles::Numbers;
pub use regulation::{BeliefRegulator, RegulatorError};
pub use settings::BeliefSettings;
pub use stops::NO_STOP;
pub use testimony::{Draft, EVIDENCE, Testimony};
