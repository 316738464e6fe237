//! Exploratory pushes: value of information for a task, candidates, and choice of the most
//! informative one.

mod choose;
mod task;

pub use choose::{Probe, ProbeRule, choose_probe};
pub(super) use task::{pays, probe};
