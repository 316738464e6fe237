//! What pushplan's published numbers are measured with.
//!
//! `bench` measures, `report` says what came of it, and `cli` is the command `pushplan-lab`, whose
//! answers stand below it in `results.md`. `parts` and `image` are networks of lever-ups that were tried and
//! lost. Nothing in `pushplan` knows this crate.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod bench;
#[doc(hidden)]
pub mod cli;
pub mod image;
pub mod parts;
#[doc(hidden)]
pub mod report;
