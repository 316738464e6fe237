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
//! so a window is looked at twice, the second time with the joints that it spoke for.

mod density;
mod filter;
mod fit;
mod joints;
mod pair;
mod relative;
mod rolled;
mod settings;
mod track;
mod window;

pub use filter::{Belief, Step};
pub use pair::JointType;
pub use settings::BeliefSettings;
