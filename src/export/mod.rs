//! Plans for other programs: so far MJCF, the scenes of MuJoCo, an engine that shares no code with
//! ours.
//!
//! A plan becomes one file that holds all of it, the pushes and the goal included
//! ([`mjcf()`]), and one script for all such files carries it out and judges it by our rules
//! ([`REPLAY_SCRIPT`]). Both are text: nothing is simulated here, nothing is written to disk, and
//! MuJoCo is no dependency. Lever-ups have a scene and a script of their own ([`lever_mjcf()`],
//! [`LEVER_SCRIPT`]). Reports for people are in [`crate::report`].

mod error;
mod forest;
mod lever;
mod mesh;
mod mjcf;
mod pairs;
mod seamless;
mod xml;

pub use error::ExportError;
pub use lever::{LEVER_SCRIPT, lever_mjcf};
pub use mjcf::{REPLAY_SCRIPT, mjcf};
