//! What an arm can do: where its flange is, which joint positions bring it somewhere, what it runs into,
//! and how its joints move through a plan of pushes.
//!
//! - `kinematics`: from joints to frames and their Jacobian; `inverse`: back, near where the joints are.
//! - `room`: what the arm, with a tool on it, runs into.
//! - `path`, `follow`: a plan becomes a [`JointTrajectory`](crate::scene::JointTrajectory).
//! - `judge`: whether such a trajectory carries a plan out, from its numbers alone: by another way than
//!   it was made.
//! - `places`: where tools can be held at all, the test that is cheap enough for a search.
//!
//! No files are read here, and how the table answers is not asked.
//!
//! The kinematics are our own hundred lines on nalgebra. The crate for them is `k` of openrr (0.32): it
//! brings a second nalgebra (0.30), holds every joint behind a lock, which a search on all cores waits
//! for, reads URDF without places through `urdf-rs`, and its solver gives up at a joint's limit rather
//! than move the others on. `rs-opw-kinematics` (3.0) is for six joints with a spherical wrist: neither
//! a Panda nor a UR5 has one. What is here is compared with Pinocchio in
//! `crates/python/tests/test_arm.py`.

mod follow;
mod inverse;
mod judge;
mod kinematics;
mod path;
mod places;
mod room;

pub use follow::{Followed, follow};
pub use inverse::{inverse, postures};
pub use judge::judge;
pub use kinematics::{dexterity, flange, frames};
pub use places::{Ring, find_places, usual_home};
pub use room::{above, pairs};
