//! Infeasibility: the cause that prevents a plan, and how it is found.
//!
//! [`beyond`] answers without a search. Otherwise each limit in `limits` is relaxed separately, and
//! the first relaxed task with a working plan names the cause. `obstructed` removes all bodies and
//! names the ones that the plan meets. [`Hints`] of the failed search order the limits. A plan
//! counts if its nominal replays work in both engines; perturbed replays are not made.

mod beyond;
mod cause;
mod enclosed;
mod find;
mod hints;
mod limits;
mod obstructed;
mod relaxed;
mod words;

pub(super) use beyond::{beyond, out_of_reach};
pub use cause::Cause;
pub(super) use find::cause;
pub(super) use hints::Hints;
