//! The networks as candle graphs: what training differentiates, and the reference that the fused
//! forward passes of `pushplan` are held to.
//!
//! The physics predictor and the belief regulator are those of the Belief Regulated Dual Propagation
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
