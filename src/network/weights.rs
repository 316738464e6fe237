//! The weights file: parameters with everything needed to use and to judge them.
//!
//! A safetensors file whose metadata hold one JSON text: the format number, a checksum over the
//! card and all tensors, and the [`Card`]. Reading checks every name, shape and number: loading
//! into an empty map must never look like success.

use std::fmt;
use std::path::Path;

use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{
    checksum::{checksum, extend},
    scene::Ranges,
};

use super::{
    Config, Normaliser, Parameters, Tables, layout,
    normaliser::MIN_DEVIATION,
    tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata},
};

/// Version of the feature layout and file format; a file of another version is refused.
const FORMAT: u32 = 4;

/// Largest magnitude of a parameter, a mean or a deviation. Those of trained networks stay below 4;
/// far beyond, products of single precision overflow.
const LARGEST: f32 = 1e3;

/// Largest held-out error that a card may state, metres: longer than any table.
const LARGEST_ERROR: f64 = 100.0;

/// Key of the card in the file's metadata.
const KEY: &str = "pushplan";

/// Why a weights file cannot be used.
#[derive(Error)]
pub enum WeightsError {
    /// The file cannot be read.
    #[error("cannot read the file: {0}")]
    Unreadable(#[from] std::io::Error),
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
    #[error("the weights file has format {found}, this program reads {FORMAT}; train again")]
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
    /// The bytes are not those that were written.
    #[error(
        "the weights file is damaged: its checksum is {found}, but was {written} when it was written"
    )]
    Checksum {
        /// In the file.
        written: String,
        /// Of what was read.
        found: String,
    },
    /// A number of the card or a parameter that no sound network has.
    #[error("the weights file holds an impossible value: {name} is {value}, {expected} is sound")]
    Value {
        /// Which number.
        name: String,
        /// The number.
        value: f64,
        /// What would be sound.
        expected: &'static str,
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Errors of final positions, one object, on the training's own held-out episodes, if there
    /// were any.
    pub errors: Option<ErrorCard>,
}

/// A card and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    /// What they are.
    pub card: Card,
    /// Their values.
    pub parameters: Parameters,
}

/// The text of the metadata.
#[derive(Serialize, Deserialize)]
struct Header {
    format: u32,
    checksum: String,
    card: Card,
}

/// What is read first of it: a header of another format may have other keys.
#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

impl Weights {
    /// The file's bytes; the same weights give the same bytes.
    ///
    /// # Errors
    /// If a parameter's length does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WeightsError> {
        let header = Header { format: FORMAT, checksum: self.checksum()?, card: self.card.clone() };
        let header = serde_json::to_string(&header)?;
        Ok(encode_parameters(&layout(&self.card.config), &[("", &self.parameters)], (KEY, header))?)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`WeightsError`] if it cannot be read or is not a sound weights file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, WeightsError> {
        Self::from_bytes(&std::fs::read(path)?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`WeightsError`] if they are not a complete, sound and undamaged weights file of this
    /// version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WeightsError> {
        let text = file_metadata(bytes, KEY)?.ok_or(WeightsError::Foreign)?;
        let FormatOnly { format: found } = serde_json::from_str(&text)?;
        if found != FORMAT {
            return Err(WeightsError::Version { found });
        }
        let Header { checksum: written, card, .. } = serde_json::from_str(&text)?;
        let Config { width, steps } = card.config;
        if !(2..=4096).contains(&width) || width % 2 != 0 || !(1..=16).contains(&steps) {
            return Err(WeightsError::Size { width, steps });
        }
        check_card(&card)?;
        let file = SafeTensors::deserialize(bytes)?;
        let parameters = decode_parameters(&file, &layout(&card.config), "")?;
        check_parameters(&parameters)?;
        let weights = Self { card, parameters };
        let found = weights.checksum()?;
        if written != found {
            return Err(WeightsError::Checksum { written, found });
        }
        Ok(weights)
    }

    /// Checksum of the card and of every tensor with its name, hexadecimal.
    fn checksum(&self) -> Result<String, WeightsError> {
        let card = serde_json::to_string(&self.card)?;
        let sum = self.parameters.values.iter().fold(checksum(card.as_bytes()), |sum, tensor| {
            let (name, values) = tensor;
            values
                .iter()
                .fold(extend(sum, name.as_bytes()), |sum, value| extend(sum, &value.to_le_bytes()))
        });
        Ok(format!("{sum:016x}"))
    }
}

pub(super) fn check_parameters(parameters: &Parameters) -> Result<(), WeightsError> {
    for (name, values) in &parameters.values {
        if let Some(value) = values.iter().find(|value| value.abs() > LARGEST) {
            let (name, value) = (format!("`{name}`"), f64::from(*value));
            return Err(WeightsError::Value { name, value, expected: "up to 1000" });
        }
    }
    Ok(())
}

fn check_card(card: &Card) -> Result<(), WeightsError> {
    check_normaliser(&card.normaliser, &Tables::PUSHES)?;
    if let Some((name, value)) = card.ranges.unsound() {
        let name = format!("ranges.{name}");
        return Err(WeightsError::Value { name, value, expected: "a number up to its upper end" });
    }
    let errors = card
        .errors
        .iter()
        .flat_map(|errors| [("mean", errors.mean), ("median", errors.median), ("p95", errors.p95)]);
    for (name, value) in errors {
        if !(0.0..=LARGEST_ERROR).contains(&value) {
            let name = format!("errors.{name}");
            return Err(WeightsError::Value { name, value, expected: "0 to 100 m" });
        }
    }
    Ok(())
}

pub(super) fn check_normaliser(
    normaliser: &Normaliser,
    Tables { node, relation, .. }: &Tables,
) -> Result<(), WeightsError> {
    for (name, table, columns) in [
        ("node_even", &normaliser.node_even, node[0]),
        ("node_odd", &normaliser.node_odd, node[1]),
        ("relation_even", &normaliser.relation_even, relation[0]),
        ("relation_odd", &normaliser.relation_odd, relation[1]),
    ] {
        let name = format!("normaliser.{name}");
        if table.mean.len() != columns || table.deviation.len() != columns {
            return Err(ParameterError { name, fault: "has a wrong length" }.into());
        }
        let mean = table.mean.iter().find(|x| !(-LARGEST..=LARGEST).contains(*x));
        let deviation = table.deviation.iter().find(|x| !(MIN_DEVIATION..=LARGEST).contains(*x));
        if let Some(value) = mean {
            let (name, value) = (format!("{name}.mean"), f64::from(*value));
            return Err(WeightsError::Value { name, value, expected: "-1000 to 1000" });
        }
        if let Some(value) = deviation {
            let (name, value) = (format!("{name}.deviation"), f64::from(*value));
            return Err(WeightsError::Value { name, value, expected: "0.02 to 1000" });
        }
    }
    Ok(())
}
