//! The arm of a task's robot: from the URDF that it names, or as plan files hold it.
//!
//! A URDF is read as far as an arm needs it: the chain of joints from its root to the flange, their
//! limits, and the collision solids of links that move with them. What else hangs there, such as a
//! gripper beyond the flange, is not. Without the feature `formats` only plan files have arms.

mod build;
mod spec;
#[cfg(feature = "formats")]
mod urdf;

pub(super) use build::{Standing, arm, check};
pub(super) use spec::{ARM, BASE, FLANGE, HOME, TOOL_MOUNT, URDF};
