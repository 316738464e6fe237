//! Lever-ups: a blade goes under the edge of a plate and rotates about a horizontal axis.

mod action;
mod rules;
mod support;

pub use action::{LeverJob, LeverUp, Place, lever_frame};
pub use rules::{LeverRules, Pivot};
