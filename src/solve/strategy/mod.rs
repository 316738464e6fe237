//! Strategies that propose plans, one file each. Their order is defined in [`order`](for_pushes).
//!
//! No strategy verifies, grades or stores attempts: the main loop does so with the batches that
//! strategies return.

mod change_tool;
mod clear;
mod escalate;
mod fine_offsets;
mod harden;
mod lever;
mod order;
mod push;
mod transport;

pub(super) use order::{for_levers, for_pushes};
pub use transport::Approach;
pub(super) use transport::approach;
