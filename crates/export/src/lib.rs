//! Export of plans: MJCF for MuJoCo, an engine that shares no code with ours, and MCAP
//! (feature `mcap`), recordings for robotics viewers.
//!
//! A plan becomes one self-contained file with its pushes and goal ([`mjcf()`]). One script for all
//! such files executes the plan and judges it by our rules ([`REPLAY_SCRIPT`], or [`LEVER_SCRIPT`]
//! for motions that leave the plane). An MCAP file contains a plan and its predicted trajectory.
//!
//! This crate neither simulates nor writes to disk, and MuJoCo is not a dependency. Reports for
//! people are in `pushplan-report`.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod arm;
mod error;
mod forest;
#[cfg(feature = "mcap")]
mod foxglove;
mod hinges;
mod joints;
#[cfg(feature = "mcap")]
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

#[cfg(feature = "mcap")]
pub use self::mcap::mcap;
pub use error::ExportError;
pub use joints::{joint_table, joint_trajectory};
pub use mjcf::{FRAMES_SCRIPT, REPLAY_SCRIPT, mjcf, motion_mjcf};
pub use space::{LEVER_SCRIPT, lever_mjcf};
