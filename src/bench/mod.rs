//! Suites, baselines, statistics and timings: what the published numbers are made of.
//!
//! Everything is seeded, takes any [`crate::effect::EffectModel`] and gives plain data that can
//! be written as JSON; nothing is drawn here.

mod heldout;
mod statistics;
mod suite;

pub use heldout::{DISTURBANCE, ErrorRow, HeldOut, HeldOutErrors, HeldOutReport, MOVED};
pub use statistics::{Summary, mean, percentile};
pub use suite::{Case, Suite, SuiteKind};
