//! The regulator's weights file: parameters with everything needed to use and to judge them.

use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};

use crate::{
    checksum::{checksum, extend},
    network::{
        Parameters, Statistics, WeightsError,
        normaliser::MIN_DEVIATION,
        tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata},
    },
};

use super::layout::regulator_layout;

/// Version of the feature layout and file format; a file of another version is refused.
const FORMAT: u32 = 2;

/// Key of the card in the file's metadata.
const KEY: &str = "pushplan-regulator";

/// Largest magnitude of a parameter, a mean or a deviation.
const LARGEST: f32 = 1e3;

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegulatorCard {
    /// Number of features of a pair, F.
    pub features: usize,
    /// Width of the hidden state, H.
    pub width: usize,
    /// Feature scales.
    pub scales: Statistics,
    /// Seed of the training data.
    pub data_seed: u64,
    /// Training episodes.
    pub episodes: u64,
    /// Optimiser steps taken.
    pub steps: u64,
}

/// A card and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct RegulatorWeights {
    /// What they are.
    pub card: RegulatorCard,
    /// Their values.
    pub parameters: Parameters,
}

/// The text of the metadata.
#[derive(Serialize, Deserialize)]
struct Header {
    format: u32,
    checksum: String,
    card: RegulatorCard,
}

/// What is read first of it: a header of another format may have other keys.
#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

impl RegulatorWeights {
    /// The file's bytes; the same weights give the same bytes.
    ///
    /// # Errors
    /// If a parameter's length does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WeightsError> {
        let header = Header { format: FORMAT, checksum: self.checksum()?, card: self.card.clone() };
        let header = serde_json::to_string(&header)?;
        let layout = regulator_layout(self.card.features, self.card.width);
        Ok(encode_parameters(&layout, &[("", &self.parameters)], (KEY, header))?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`WeightsError`] if they are not a complete, sound and undamaged file of this version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WeightsError> {
        let text = file_metadata(bytes, KEY)?.ok_or(WeightsError::Foreign)?;
        let FormatOnly { format: found } = serde_json::from_str(&text)?;
        if found != FORMAT {
            return Err(WeightsError::Version { found });
        }
        let Header { checksum: written, card, .. } = serde_json::from_str(&text)?;
        let RegulatorCard { features, width, .. } = card;
        if !(1..=4096).contains(&width) || !(1..=4096).contains(&features) {
            return Err(WeightsError::Size { width, steps: 1 });
        }
        for (name, values, least) in [
            ("scales.mean", &card.scales.mean, -LARGEST),
            ("scales.deviation", &card.scales.deviation, MIN_DEVIATION),
        ] {
            if values.len() != features || values.iter().any(|x| !(least..=LARGEST).contains(x)) {
                let fault = "has a wrong length or an impossible value";
                return Err(ParameterError { name: name.to_owned(), fault }.into());
            }
        }
        let file = SafeTensors::deserialize(bytes)?;
        let parameters = decode_parameters(&file, &regulator_layout(features, width), "")?;
        if let Some((name, _)) =
            parameters.values.iter().find(|(_, values)| values.iter().any(|x| x.abs() > LARGEST))
        {
            let fault = "holds an impossible value";
            return Err(ParameterError { name: name.clone(), fault }.into());
        }
        let weights = Self { card, parameters };
        let found = weights.checksum()?;
        match written == found {
            true => Ok(weights),
            false => Err(WeightsError::Checksum { written, found }),
        }
    }

    /// Checksum of the card and of every tensor with its name, hexadecimal.
    fn checksum(&self) -> Result<String, WeightsError> {
        let card = serde_json::to_string(&self.card)?;
        let mut sum = checksum(card.as_bytes());
        for (name, values) in &self.parameters.values {
            sum = extend(sum, name.as_bytes());
            sum = values.iter().fold(sum, |sum, value| extend(sum, &value.to_le_bytes()));
        }
        Ok(format!("{sum:016x}"))
    }
}
