//! Closed loop over a [`World`], beliefs about objects, and errors of models against observations.
//!
//! - [`judge`]: errors of predictions against recorded and simulated motion,
//! - [`fit`]: frictions, supports and an adapted network from recordings of a table,
//! - [`belief`]: what objects are like, from observed motion,
//! - [`regulator`]: the network that corrects beliefs about joints,
//! - [`act`]: the closed loop.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod act;
pub mod belief;
pub mod fit;
pub mod judge;
pub mod regulator;

pub use act::{
    ActError, Look, RunSettings, Runner, SimulatedWorld, Trace, World, WorldError, hidden,
};
