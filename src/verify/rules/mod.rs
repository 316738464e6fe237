//! Rule book: violations of the task's rules and of the robot's abilities that a plan shows before
//! any motion.
//!
//! Each rule matches on the step, and all rules apply to every plan. They are independent of the
//! planner's own rules, which are stricter because the planner keeps safety distances.

mod book;
mod clearance;
mod hand;
mod lever;
mod playable;
mod push;
mod reach;
mod tools;

pub use book::rule_violations;
pub(super) use hand::hand_meets;
pub(super) use playable::unplayable;

/// Slack for rounding, metres and radians.
const SLACK: f64 = 1e-5;
