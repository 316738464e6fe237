//! Errors of building effect models.

use std::fmt;

use thiserror::Error;

use crate::network::WeightsError;

/// Reason why a model cannot be built.
#[derive(Error)]
pub enum ModelError {
    /// A damaged weights file in the library itself.
    #[error("the shipped weights are broken: {0}")]
    Shipped(#[source] WeightsError),
    /// A weights file that is missing, damaged or foreign.
    #[error("{path}: {error}")]
    File {
        /// Path of the file.
        path: String,
        /// Error of the file.
        #[source]
        error: WeightsError,
    },
    /// A model from outside the library.
    #[error("the library has no model `{0}`; create it with the crate that defines it")]
    Custom(&'static str),
    /// A table fit that was learned with another network.
    #[error(
        "the fit was learned with other weights ({weights}) than the model has; fit again with \
         this model"
    )]
    Fit {
        /// Checksum of the weights with which the fit was learned.
        weights: String,
    },
}

/// Prints the text of [`Display`](fmt::Display), which is readable when it leaves `main`.
impl fmt::Debug for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
