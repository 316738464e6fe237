//! What is believed about the objects of a scene, from how they were seen to move: which of them
//! hang together by which joints, and where these are.
//!
//! A filter over hypotheses, pair by pair: [`Belief::update`] has the effect model roll out what
//! the tool did under every type of joint of every pair of near objects that moved, and compares
//! what was seen with each in that joint's own coordinates (`fit`): what the joint holds against
//! where it held it so far, what it leaves free against the rollout.
//!
//! A heading that is not seen is the one rolled out plus an error that every hypothesis estimates for
//! itself, together with its geometry. What a hypothesis says then rests on how all of a group moves,
//! so a window is looked at twice, the second time with the joints that it spoke for, and after a push
//! whole assignments of joints are played again and compared (`group`).
//!
//! A joint that stays where it is though a rollout goes on has come to a stop, which is learned (`stops`).
//! What is foreseen is the middle of what drawn physics lead to (`foreseen`).
//!
//! A [`BeliefRegulator`] may correct what the filter finds: a recurrent network that reads what every
//! window told of a pair (`testimony`).
//!
//! Beside it, where these are unknown, particles of masses, frictions and supports, weighed after
//! every push under the joints that are likeliest then; and masses that are in one of a few ranges far
//! apart (`masses`).

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
