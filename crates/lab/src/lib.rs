//! Measurements behind pushplan's published numbers.
//!
//! `bench` measures, `report` presents the results, and `cli` is the command `pushplan-lab`, whose
//! outputs are on the pages of `results`; `published` lists their tables. `image` and `parts` are
//! rejected networks for lever-ups, and `trivial` holds baseline models of pushes that any model
//! must beat. No crate of the product depends on this one.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod bench;
#[doc(hidden)]
pub mod cli;
pub mod image;
pub mod parts;
pub mod published;
#[doc(hidden)]
pub mod report;
pub mod trivial;
