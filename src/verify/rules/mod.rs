//! Rule book: the rules of the task and the limits of the robot, checked for a plan without
//! simulation.
//!
//! Each rule handles every type of step, and all rules apply to every plan. They are independent of
//! the planner's own rules, which are stricter because the planner keeps safety distances.

mod blade;
mod book;
mod clearance;
mod hand;
mod lever;
mod playable;
mod push;
mod reach;
mod tools;
mod travel;

pub use book::rule_violations;
pub(super) use hand::hand_meets;
pub(super) use playable::unplayable;
pub(super) use travel::travel_faults;

/// Slack for rounding, metres and radians.
const SLACK: f64 = 1e-5;
