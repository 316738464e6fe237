//! Random tasks that are solvable by construction.
//!
//! The goals of each task are the true outcome of a plan that the task allows. [`random_task`] uses
//! the 2-D engine (one object, one push; the tasks that measure refinement). [`RandomSuite`] uses
//! both engines (several kinds, up to five pushes), so that the plan behind a task passes its
//! verification.

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
