//! Robot arms for pushplan: the pose of the flange, joint positions that bring it somewhere, collisions,
//! and the motion of the joints through a plan of pushes.
//!
//! The library knows an arm only as a [`RobotArm`](pushplan::task::RobotArm). [`install`] registers the
//! reader of this crate; after that a task file may name a URDF, and a plan file may hold an arm:
//!
//! ```
//! pushplan_arm::install();
//! ```
//!
//! - `model`: an [`Arm`], plain data; `hull`: its solids; `places`: where it holds tools at all, the test
//!   that is cheap enough for a search, found by trying (`find`).
//! - `read`, `urdf`: from the keys of a file, or from a URDF. Of that the chain of joints from its root to
//!   the flange is read, their limits, and the collision solids of links that move with them.
//! - `kinematics`: from joints to frames and their Jacobian; `inverse`: back, near where the joints are.
//! - `room`: what the arm, with a tool on it, runs into.
//! - `path`, `follow`: a plan becomes a [`JointTrajectory`](pushplan::scene::JointTrajectory).
//! - `judge`: the check of such a trajectory from its numbers alone, by another way than it was made.
//!
//! The response of the table is not modelled here.
//!
//! The kinematics are our own hundred lines on nalgebra. The crate for them is `k` of openrr (0.32): it
//! brings a second nalgebra (0.30), holds every joint behind a lock, which a search on all cores waits
//! for, reads URDF without places through `urdf-rs`, and its solver gives up at a joint's limit rather
//! than move the others on. `rs-opw-kinematics` (3.0) is for six joints with a spherical wrist: neither
//! a Panda nor a UR5 has one. What is here is compared with Pinocchio in
//! `crates/python/tests/test_arm.py`.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod find;
mod follow;
mod hull;
mod inverse;
mod judge;
mod kinematics;
mod model;
mod path;
mod places;
mod read;
mod room;
#[cfg(feature = "urdf")]
mod urdf;

pub use hull::Hull;
pub use model::{Arm, ArmBody, ArmJoint, ToolMount};
pub use places::Places;
pub use read::install;
pub use room::above;
