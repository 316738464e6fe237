//! Replays of plans in the simulator, nominal and perturbed, and verdicts with evidence.
//!
//! A plan passes if it violates no rule of its task and its nominal replays reach the goal at rest
//! in both engines. The required share of perturbed replays must also reach it. Steps that leave
//! the plane are replayed in 3-D only. This module is independent of how plans are found.

mod arm;
mod conditions;
mod force;
mod inner_corners;
mod perturbation;
mod rules;
mod sequential_test;
mod space;
mod table_edge;
mod tightened;
mod verifier;

pub use arm::joints;
pub use rules::rule_violations;
pub use verifier::{Verifier, VerifySettings};
