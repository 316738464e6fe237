//! Replays plans in the simulator, as written and disturbed, and gives a verdict with evidence.
//!
//! A plan passes when it breaks no rule of its task, its replays as written reach the goal at rest
//! in both engines, and so does a wanted share of those with small errors. Knows nothing of how
//! plans are found.

mod disturbance;
mod lever;
mod rules;
mod verifier;

pub use lever::LeverVerifier;
pub use verifier::{Verifier, VerifySettings};
