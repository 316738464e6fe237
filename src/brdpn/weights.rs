//! The weights file: parameters with everything needed to use and to judge them.
//!
//! A safetensors file whose metadata hold one JSON text, the [`Card`]. Reading checks every
//! name, shape and number: loading into an empty map must never look like success.

use std::collections::HashMap;

use safetensors::{Dtype, SafeTensors, tensor::TensorView};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::scene::Ranges;

use super::{Config, Normaliser, Parameters, layout};

/// Version of the feature layout and file format; a file of another version is refused.
const FORMAT: u32 = 1;

/// Key of the card in the file's metadata.
const KEY: &str = "pushplan";

/// Why a weights file cannot be used.
#[derive(Debug, Error)]
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
    /// A parameter is missing, unexpected or has a wrong shape.
    #[error("the weights file's parameter `{name}` {fault}")]
    Parameter {
        /// Which.
        name: String,
        /// What is wrong.
        fault: String,
    },
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
        let raw: Vec<(&str, Vec<usize>, Vec<u8>)> = layout(&self.card.config)
            .into_iter()
            .map(|(name, shape)| {
                let values = self.parameters.values.get(name).map_or(&[][..], Vec::as_slice);
                (name, shape, values.iter().flat_map(|x| x.to_le_bytes()).collect())
            })
            .collect();
        let views = raw
            .iter()
            .map(|(name, shape, bytes)| {
                Ok((*name, TensorView::new(Dtype::F32, shape.clone(), bytes)?))
            })
            .collect::<Result<Vec<_>, WeightsError>>()?;
        let metadata = HashMap::from([(KEY.to_owned(), serde_json::to_string(&self.card)?)]);
        Ok(safetensors::serialize(views, Some(metadata))?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`WeightsError`] if they are not a complete, finite weights file of this version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WeightsError> {
        let (_, metadata) = SafeTensors::read_metadata(bytes)?;
        let text = metadata.metadata().as_ref().and_then(|m| m.get(KEY));
        let text = text.ok_or(WeightsError::Foreign)?;
        let found: FormatOnly = serde_json::from_str(text)?;
        if found.format != FORMAT {
            return Err(WeightsError::Version { found: found.format });
        }
        let card: Card = serde_json::from_str(text)?;
        let Config { width, steps } = card.config;
        if !(2..=4096).contains(&width) || width % 2 != 0 || !(1..=16).contains(&steps) {
            return Err(WeightsError::Size { width, steps });
        }
        check_normaliser(&card.normaliser)?;
        let file = SafeTensors::deserialize(bytes)?;
        let mut parameters = Parameters::default();
        for (name, shape) in layout(&card.config) {
            let fault = |fault: &str| WeightsError::Parameter {
                name: name.to_owned(),
                fault: fault.to_owned(),
            };
            let view = file.tensor(name).map_err(|_| fault("is missing"))?;
            if view.dtype() != Dtype::F32 || view.shape() != shape {
                return Err(fault("has a wrong type or shape"));
            }
            let values: Vec<f32> = view
                .data()
                .chunks_exact(4)
                .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
                .collect();
            if values.iter().any(|x| !x.is_finite()) {
                return Err(fault("holds a number that is not finite"));
            }
            parameters.values.insert(name.to_owned(), values);
        }
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
            return Err(WeightsError::Parameter {
                name: format!("normaliser.{name}"),
                fault: "is damaged".to_owned(),
            });
        }
    }
    Ok(())
}
