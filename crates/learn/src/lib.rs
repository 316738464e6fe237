//! Makes what pushplan's networks are: data from simulation, and weights trained on them.
//!
//! `dataset` draws scenes and motions and has an engine say what they do; `network` is the candle
//! graph of every network that `pushplan` runs without candle; `train` fits the one to the other;
//! `cli` is the command `pushplan-learn`. Nothing in `pushplan` knows this crate.
#![deny(unsafe_code)]
#![warn(missing_docs)]

#[doc(hidden)]
pub mod cli;
pub mod dataset;
pub mod judge;
pub mod lever_model;
pub mod network;
#[doc(hidden)]
pub mod report;
pub mod train;
