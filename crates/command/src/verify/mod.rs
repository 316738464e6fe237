//! `pushplan verify`: replays plans and gives verdicts.
//!
//! `command` has the arguments and our own replays. `mujoco` asks MuJoCo for a second opinion, in
//! the Python that `python` finds.

pub mod command;
pub mod mujoco;
pub mod python;

pub use command::{VerifyArgs, run};
