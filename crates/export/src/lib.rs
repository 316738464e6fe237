//! Plans for other programs: MJCF, the scenes of MuJoCo, an engine that shares no code with ours, and
//! MCAP, the recordings that viewers of robots play.
//!
//! A plan becomes one file that holds all of it, the pushes and the goal included ([`mjcf()`]), and
//! one script for all such files carries it out and judges it by our rules ([`REPLAY_SCRIPT`], and
//! [`LEVER_SCRIPT`] where something leaves the plane). An MCAP file holds a plan and what a model
//! says it does. Nothing is simulated here, nothing is written to disk, and MuJoCo is not a
//! dependency. Reports for people are in `pushplan-report`.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod arm;
mod error;
mod forest;
mod foxglove;
mod hinges;
mod joints;
mod mcap;
mod mesh;
mod mjcf;
mod pairs;
mod regions;
mod seamless;
mod solids;
mod space;
mod strokes;
mod tool;
mod wanted;
mod xml;

pub use self::mcap::mcap;
pub use error::ExportError;
pub use joints::{joint_table, joint_trajectory};
pub use mjcf::{FRAMES_SCRIPT, REPLAY_SCRIPT, mjcf, motion_mjcf};
pub use space::{LEVER_SCRIPT, lever_mjcf};
