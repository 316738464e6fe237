//! Strategies: the ways to come to plans, a file each. Their order stands in [`order`](for_pushes).
//!
//! None verifies, grades or keeps attempts: that is done with the batches that they return.

mod change_tool;
mod clear;
mod harden;
mod lever;
mod order;
mod push;
mod transport;

pub(super) use order::{for_levers, for_pushes};
pub use transport::Approach;
pub(super) use transport::approach;
