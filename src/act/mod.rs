//! The closed loop: plan under what is believed, push, look, believe, plan again.
//!
//! A [`Runner`] does that in any [`World`], a robot's table or a [`SimulatedWorld`] with a hidden
//! truth, and writes down everything in a [`Trace`], from which it can go on after an interruption.
//! What it sees may be incomplete and in disorder: see `gather`. Nothing is planned, predicted or
//! inferred here; that is for `solve`, `effect` and `belief`.

mod decide;
mod error;
mod gather;
mod judge;
mod runner;
mod settings;
mod simulated;
mod trace;
mod world;

pub use error::ActError;
pub use gather::Note;
pub use judge::Chance;
pub use runner::Runner;
pub use settings::RunSettings;
pub use simulated::{SimulatedWorld, hidden};
pub use trace::{End, Step, TRACE_VERSION, Trace, Why};
pub use world::{Look, World, WorldError, WorldState};
