//! The networks: configuration, parameters, physics predictor and weights file.
//!
//! The physics predictor of the Belief Regulated Dual Propagation Network (Tekden, Erdem,
//! Erdem, Imre, Seker and Ugur, ICRA 2020) is a fused forward pass on preallocated buffers, on
//! feature tables of any widths; a test holds it to the graph that training differentiates. The
//! belief regulator (crate `pushplan-act`) reads its effects. Every network's weights are a file of one form, and a
//! [`Card`] that says which. Loops over time are not here but in `rollout`.

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
pub use forward::{Buffers, Forward};
pub use head::{HEAD_OUTPUTS, Head};
pub use lever::{
    LEVER_ENDS, LEVER_POSE, LeverCard, LeverCell, LeverSizes, LeverTold, LeverWeights, fresh_lever,
    fresh_lever_values, lever_layout, tanh,
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
