//! Training data from simulation, and training of pushplan's networks.
//!
//! `dataset` draws scenes and motions and simulates them. `network` contains the candle graphs of
//! all networks that `pushplan` runs without candle. `train` fits the networks to the data, and
//! `cli` is the command `pushplan-learn`. `pushplan` does not depend on this crate.
#![deny(unsafe_code)]
#![warn(missing_docs)]

#[doc(hidden)]
pub mod cli;
pub mod compare;
pub mod dataset;
pub mod judge;
pub mod lever_model;
pub mod network;
#[doc(hidden)]
pub mod report;
pub mod train;
