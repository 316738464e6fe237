//! Robot arms for pushplan: forward and inverse kinematics, collisions, and joint trajectories for
//! plans of pushes.
//!
//! The core library accesses an arm only through [`RobotArm`](pushplan::task::RobotArm).
//! [`install`] registers the reader of this crate. Afterwards a task file may name a URDF, and a
//! plan file may contain an arm:
//!
//! ```
//! pushplan_arm::install();
//! ```
//!
//! - `model`: an [`Arm`], plain data; `hull`: its solids; `places`: the poses at which it can hold
//!   tools, cheap enough for a search and computed by `find`.
//! - `read`, `urdf`: readers for the keys of a file and for URDFs. A URDF provides the joint chain
//!   from its root to the flange, joint limits, and the collision solids of the links.
//! - `mesh_files`: the meshes that a URDF names, in its folder or in an allowed one.
//! - `kinematics`: frames and Jacobian from joint positions; `inverse`: joint positions from a
//!   pose.
//! - `room`: collisions of the arm and its tool; `foot`: the root link as obstacles.
//! - `path`, `free`, `follow`: conversion of a plan to a
//!   [`JointTrajectory`](pushplan::scene::JointTrajectory).
//! - `timing`: speeds along the path, within the limits of the joints, which `strain` measures.
//! - `judge`, `pace`: independent check of such a trajectory from its numbers only.
//!
//! The response of the table is not modelled here.
//!
//! The kinematics are about a hundred lines on nalgebra. The alternative crate `k` of openrr (0.32)
//! requires a second nalgebra (0.30) and guards every joint by a lock, which blocks a parallel
//! search. It also reads URDF through `urdf-rs` without error locations, and its solver stops at a
//! joint's limit instead of moving the other joints. `rs-opw-kinematics` (3.0) supports six joints
//! with a spherical wrist, which neither a Panda nor a UR5 has. `crates/python/tests/test_arm.py`
//! compares the results with Pinocchio.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod find;
mod follow;
mod foot;
mod free;
mod hull;
mod inverse;
mod judge;
mod kinematics;
#[cfg(feature = "urdf")]
mod mesh_files;
mod model;
mod pace;
mod path;
mod places;
mod read;
mod room;
mod strain;
mod timing;
#[cfg(feature = "urdf")]
mod urdf;

pub use hull::Hull;
#[cfg(feature = "urdf")]
pub use mesh_files::allow_files_in;
pub use model::{Arm, ArmBody, ArmJoint, ToolMount};
pub use places::Places;
pub use read::install;
pub use room::above;
