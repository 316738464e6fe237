//! Closed loop over a [`World`], beliefs about objects, and errors of models against observations.
//!
//! - [`judge`]: errors of predictions against recorded and simulated motion,
//! - [`fit`]: frictions, supports and an adapted network from recordings of a table,
//! - [`belief`]: joints and parameters of objects, from observed motion,
//! - [`regulator`]: network that corrects beliefs about joints,
//! - [`act`]: closed loop.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod act;
pub mod belief;
pub mod fit;
pub mod judge;
pub mod regulator;

pub use act::{
    ActError, End, Look, RunSettings, Runner, SimulatedWorld, Stop, Trace, World, WorldError,
    WorldState, hidden,
};
