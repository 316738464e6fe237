//! Replays plans in the simulator, as written and disturbed, and gives a verdict with evidence.
//!
//! A plan passes when its nominal replay in the 3-D engine reaches the goal at rest; the planar
//! replay and the disturbed ones stand beside it. Knows nothing of how plans are found.

mod disturbance;
mod verifier;

pub use verifier::{Verifier, VerifySettings};
