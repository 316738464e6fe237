//! Keys of an arm: a URDF named by a task, or the arm stored in a plan file. The registered reader
//! builds the arm from them, see [`read_arms_with`](crate::task::read_arms_with).

mod build;
mod spec;

pub(super) use build::{arm, check};
pub(super) use spec::{ARM, BASE, BASE_POSE, FLANGE, HOME, JOINT_LIMITS, TOOL_MOUNT, URDF};
