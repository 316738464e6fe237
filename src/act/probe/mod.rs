//! Pushes that are made to learn something: of a task, whether that pays and which there are; and
//! which of several tells most.

mod choose;
mod task;

pub use choose::{Probe, ProbeRule, choose_probe};
pub(super) use task::{pays, probe};
