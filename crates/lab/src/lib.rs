//! What pushplan's published numbers are measured with.
//!
//! `bench` measures, `report` presents the results, and `cli` is the command `pushplan-lab`, whose
//! answers are in `results.md`. `image` and `parts` are networks of lever-ups that were tried and lost,
//! and `trivial` models of pushes that any model must beat.
//! Nothing in `pushplan` knows this crate.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod bench;
#[doc(hidden)]
pub mod cli;
pub mod image;
pub mod parts;
#[doc(hidden)]
pub mod report;
pub mod trivial;
