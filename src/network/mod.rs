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
mod parameters;
mod parity;
mod parts;
mod regulator;
mod tables;
mod tensors;
mod weights;

pub use config::Config;
pub use forward::{Buffers, Forward, matrix_product};
pub use lever::{
    Convolution, ImageSizes, LEVER_ENDS, LEVER_POSE, LeverCard, LeverCell, LeverSizes, LeverTold,
    LeverWeights, fresh_bound, fresh_lever, image_layout, lever_layout,
};
pub use normaliser::{Normaliser, Statistics};
pub use parameters::{Parameters, layout, layout_of};
pub use parity::{Sum, rectify_rows};
pub use parts::{PARTS, PartsCard, PartsWeights};
pub use regulator::{
    LEAST, Memory, Regulator, RegulatorCard, RegulatorWeights, TYPES, fresh_regulator,
    regulator_layout,
};
pub use tables::{Rows, Tables};
pub use tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata};
pub use weights::{Card, ErrorCard, Weights, WeightsError};
