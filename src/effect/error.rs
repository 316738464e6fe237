//! Errors of making effect models.

use std::fmt;

use thiserror::Error;

use crate::network::WeightsError;

/// Why a model cannot be made.
#[derive(Error)]
pub enum ModelError {
    /// The library was built around a damaged weights file.
    #[error("the shipped weights are broken: {0}")]
    Shipped(#[source] WeightsError),
    /// A weights file that is missing, damaged or not of pushplan.
    #[error("{path}: {error}")]
    File {
        /// The file.
        path: String,
        /// What is wrong with it.
        #[source]
        error: WeightsError,
    },
    /// A model from outside of the library.
    #[error("the library has no model `{0}`; build it where it is defined")]
    Custom(&'static str),
    /// What was learnt about a table belongs to another network.
    #[error(
        "the fit was learnt with other weights ({weights}) than those of the model; fit again with \
         this model"
    )]
    Fit {
        /// Checksum of the weights that it was learnt with.
        weights: String,
    },
}

/// The text of [`Display`](fmt::Display), so that it reads well when it leaves `main`.
impl fmt::Debug for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
