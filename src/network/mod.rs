//! The networks: configuration, parameters, physics predictor and weights file.
//!
//! The physics predictor of the Belief Regulated Dual Propagation Network (Tekden, Erdem, Erdem,
//! Imre, Seker and Ugur, ICRA 2020) is a fused forward pass on preallocated buffers. It takes
//! feature tables of any width; a test holds it to the graph that training differentiates. The
//! belief regulator (crate `pushplan-act`) reads its effects. The weights of every network are
//! stored in one file format with a [`Card`] that identifies the network. Loops over time are in
//! `rollout`.

mod config;
mod doubt;
mod forward;
mod head;
mod lever;
mod normaliser;
mod parameters;
mod parity;
mod predictor;
mod product;
mod tables;
mod tensors;
mod weights;

pub use config::Config;
pub use doubt::Doubt;
pub use forward::{Buffers, Forward, MOST_CHANGE};
pub use head::{HEAD_OUTPUTS, Head};
pub use lever::{
    LEVER_ENDS, LEVER_POSE, LeverCard, LeverCell, LeverOutput, LeverSizes, LeverWeights,
    fresh_lever, fresh_lever_values, lever_layout, tanh,
};
pub use normaliser::{Normaliser, Statistics};
pub use parameters::{Layout, Parameters, layout, layout_of};
pub use parity::{Sum, rectify_rows};
pub use predictor::{ErrorCard, PredictorCard, PredictorWeights, Source};
pub use product::matrix_product;
pub use tables::{Rows, Tables};
pub use tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata};
pub use weights::{
    Card, Weights, WeightsError, check_config, check_normaliser, check_scales, check_widths,
};
