//! The rule book: everything that a plan does that its task does not allow, or that no robot can do,
//! before anything moves.
//!
//! Rules are matched on the step, and all of them hold for every plan. They are written apart from the
//! planner's own, which are stricter: the planner keeps distances.

mod book;
mod clearance;
mod lever;
mod playable;
mod push;
mod reach;
mod tools;

pub use book::broken_rules;
pub(super) use playable::unplayable;

/// Slack for rounding, metres and radians.
const SLACK: f64 = 1e-5;
