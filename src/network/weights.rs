//! The weights file: parameters with everything needed to use and to judge them.
//!
//! A safetensors file whose metadata hold one JSON text, the [`Card`]. Reading checks every
//! name, shape and number: loading into an empty map must never look like success.

use std::fmt;

use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::scene::Ranges;

use super::{
    Config, Normaliser, Parameters,
    tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata},
};

/// Version of the feature layout and file format; a file of another version is refused.
const FORMAT: u32 = 1;

/// Key of the card in the file's metadata.
const KEY: &str = "pushplan";

/// Why a weights file cannot be used.
#[derive(Error)]
pub enum WeightsError {
    /// Not a safetensors file.
    #[error("not a weights file: {0}")]
    Format(#[from] safetensors::SafeTensorError),
    /// A safetensors file of someone else.
    #[error("a safetensors file, but not one of pushplan: its metadata have no `{KEY}` entry")]
    Foreign,
    /// The card cannot be read.
    #[error("the weights file's card is damaged: {0}")]
    Card(#[from] serde_json::Error),
    /// Written by another version.
    #[error("the weights file has format {found}, this program reads {FORMAT}; train anew")]
    Version {
        /// Format number found.
        found: u32,
    },
    /// A size that no network has.
    #[error("the weights file describes an impossible network: width {width}, {steps} steps")]
    Size {
        /// Width found.
        width: usize,
        /// Propagation steps found.
        steps: usize,
    },
    /// A parameter is missing, of a wrong shape or not finite.
    #[error("the weights file is damaged: {0}")]
    Parameter(#[from] ParameterError),
}

/// The text of [`Display`](fmt::Display), so that it reads well when it leaves `main`.
impl fmt::Debug for WeightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Held-out errors that planning needs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorCard {
    /// Held-out pushes counted (true motion over 1 cm).
    pub pushes: usize,
    /// Mean final position error, metres.
    pub mean: f64,
    /// Median, metres.
    pub median: f64,
    /// 95th percentile, metres.
    pub p95: f64,
}

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Card {
    /// Format number.
    pub format: u32,
    /// Network size.
    pub config: Config,
    /// Feature scales.
    pub normaliser: Normaliser,
    /// Ranges of the training data.
    pub ranges: Ranges,
    /// Seed of the training data.
    pub data_seed: u64,
    /// Training episodes.
    pub episodes: u64,
    /// Optimiser steps taken.
    pub steps: u64,
    /// Errors of final positions, one object, on the training's own held-out episodes.
    pub errors: ErrorCard,
}

impl Card {
    /// The present format number.
    pub const FORMAT: u32 = FORMAT;
}

/// A card and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    /// What they are.
    pub card: Card,
    /// Their values.
    pub parameters: Parameters,
}

impl Weights {
    /// The file's bytes; the same weights give the same bytes.
    ///
    /// # Errors
    /// If a parameter's length does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WeightsError> {
        let card = serde_json::to_string(&self.card)?;
        Ok(encode_parameters(&self.card.config, &[("", &self.parameters)], (KEY, card))?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`WeightsError`] if they are not a complete, finite weights file of this version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WeightsError> {
        let text = file_metadata(bytes, KEY)?.ok_or(WeightsError::Foreign)?;
        let found: FormatOnly = serde_json::from_str(&text)?;
        if found.format != FORMAT {
            return Err(WeightsError::Version { found: found.format });
        }
        let card: Card = serde_json::from_str(&text)?;
        let Config { width, steps } = card.config;
        if !(2..=4096).contains(&width) || width % 2 != 0 || !(1..=16).contains(&steps) {
            return Err(WeightsError::Size { width, steps });
        }
        check_normaliser(&card.normaliser)?;
        let file = SafeTensors::deserialize(bytes)?;
        let parameters = decode_parameters(&file, &card.config, "")?;
        Ok(Self { card, parameters })
    }
}

#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

fn check_normaliser(normaliser: &Normaliser) -> Result<(), WeightsError> {
    use crate::graph::{NODE_EVEN, NODE_ODD, RELATION_EVEN, RELATION_ODD};
    for (name, table, columns) in [
        ("node_even", &normaliser.node_even, NODE_EVEN),
        ("node_odd", &normaliser.node_odd, NODE_ODD),
        ("relation_even", &normaliser.relation_even, RELATION_EVEN),
        ("relation_odd", &normaliser.relation_odd, RELATION_ODD),
    ] {
        let good = table.mean.len() == columns
            && table.deviation.len() == columns
            && table.mean.iter().all(|x| x.is_finite())
            && table.deviation.iter().all(|x| x.is_finite() && *x > 0.0);
        if !good {
            let name = format!("normaliser.{name}");
            return Err(ParameterError { name, fault: "is damaged" }.into());
        }
    }
    Ok(())
}
