//! The keys of an arm: of the URDF that a task names, or the arm that a plan file holds. The registered
//! reader makes the arm of them, see [`read_arms_with`](crate::task::read_arms_with).

mod build;
mod spec;

pub(super) use build::{arm, check};
pub(super) use spec::{ARM, BASE, FLANGE, HOME, TOOL_MOUNT, URDF};
