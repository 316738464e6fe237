//! Networks as candle graphs, for training and as the reference for the fused forward passes of
//! `pushplan`.
//!
//! The physics predictor and the belief regulator follow the Belief Regulated Dual Propagation
//! Network (Tekden, Erdem, Erdem, Imre, Seker and Ugur, ICRA 2020).

mod lever;
mod operations;
mod predictor;
mod regulator;
mod variables;

pub use lever::{LeverGraph, LeverTensors};
pub use operations::{floats, with_floats};
pub use predictor::{Inputs, Predictor};
pub use regulator::{RegulatorGraph, Unrolled};
pub use variables::variables;
