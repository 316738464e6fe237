//! Replays plans in the simulator, as written and disturbed, and gives a verdict with evidence.
//!
//! A plan passes when it breaks no rule of its task, its replays as written reach the goal at rest
//! in both engines, and so does a wanted share of those with small errors. What leaves the plane is
//! replayed in 3-D alone. Knows nothing of how plans are found.

mod arm;
mod clear;
mod disturbance;
mod rules;
mod space;
mod verifier;

pub use arm::joints;
pub use rules::broken_rules;
pub use verifier::{Verifier, VerifySettings};
