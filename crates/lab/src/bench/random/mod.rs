//! Random tasks that are solvable by construction.
//!
//! The goals of each task are the true outcome of a plan that the task allows: in the 2-D engine
//! for [`random_task`] (one object, one push; used to measure refinement), and in both engines for
//! [`RandomSuite`] (several kinds, up to five pushes). In the suite, the plan behind a task
//! therefore passes its verification.

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
