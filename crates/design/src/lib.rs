//! Proposes a tool for a task: cuboids in one of a few forms, drawn and varied, each judged by a first
//! look, and the best of them solved with and verified like any other tool: [`design`].
//!
//! Does not draw, write files or change the library.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod assembly;
mod form;
mod proposal;
mod propose;
mod screening;
mod search;
mod settings;
mod trace;

pub use proposal::{Design, Proposal, Spent};
pub use propose::design;
pub use settings::DesignSettings;
