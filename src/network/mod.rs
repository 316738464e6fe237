//! The networks: configuration, parameters, physics predictor and weights file.
//!
//! The physics predictor of the Belief Regulated Dual Propagation Network (Tekden, Erdem,
//! Erdem, Imre, Seker and Ugur, ICRA 2020) stands here twice: as the candle graph that
//! training differentiates and that is the reference, and as a fused forward pass on preallocated
//! buffers that planning runs and that needs no candle. Both take feature tables of any widths: the parts of
//! what is levered propagate in the same way. The belief regulator reads its effects. Loops over time are not here but in
//! `rollout`.

mod config;
mod forward;
mod lever;
mod normaliser;
#[cfg(feature = "train")]
mod operations;
mod parameters;
mod parity;
mod parts;
#[cfg(feature = "train")]
mod predictor;
mod regulator;
mod tables;
mod tensors;
mod weights;

pub use config::Config;
pub use forward::{Buffers, Forward, matrix_product};
#[cfg(feature = "train")]
pub use lever::{Autoencoder, LeverGraph, LeverTensors, autoencoder_layout, fresh_autoencoder};
pub use lever::{
    ImageSizes, LEVER_ENDS, LEVER_POSE, LeverCard, LeverCell, LeverSizes, LeverTold, LeverWeights,
    fresh_lever, lever_layout,
};
pub use normaliser::{Normaliser, Statistics};
pub use parameters::{Parameters, layout, layout_of};
pub use parts::{PARTS, PartsCard, PartsWeights};
#[cfg(feature = "train")]
pub use predictor::{Inputs, Predictor};
pub use regulator::{
    LEAST, Memory, Regulator, RegulatorCard, RegulatorWeights, TYPES, fresh_regulator,
    regulator_layout,
};
#[cfg(feature = "train")]
pub use regulator::{RegulatorGraph, Unrolled};
pub use tables::{Rows, Tables};
pub use tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata};
pub use weights::{Card, ErrorCard, Weights, WeightsError};
