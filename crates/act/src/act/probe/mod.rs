//! Pushes that are made to learn something: for a task, whether that pays and which ones there are;
//! and which of several is the most informative.

mod choose;
mod task;

pub use choose::{Probe, ProbeRule, choose_probe};
pub(super) use task::{pays, probe};
