//! Random tasks that are known to be solvable.
//!
//! The goals of each are where a plan that the task allows really ends: by the planar engine in
//! [`random_task`] (one object, one push; what refinement is measured on), and by both engines in
//! [`RandomSuite`] (several kinds, up to five pushes), so that the plan that made a task passes
//! its verification.

mod cluster;
mod everyday;
mod furniture;
mod gap;
mod hidden;
mod kind;
mod layout;
mod making;
mod measure;
mod one_push;
mod suite;

pub use hidden::{HiddenTask, HiddenWorld};
pub use kind::TaskKind;
pub use measure::{Choice, Maker, RandomError, RandomRecord};
pub use one_push::random_task;
pub use suite::{NoTask, RandomSuite, SuiteTask};
