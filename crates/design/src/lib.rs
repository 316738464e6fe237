//! Tool design: proposes a tool for a task, see [`design`].
//!
//! Candidates are assemblies of cuboids in a few forms. They are sampled, varied and screened. The
//! task is solved with the best of them, and the plans are verified as for any other tool.
//!
//! This crate does not draw, write files or change the library.
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
