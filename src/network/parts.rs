//! The network of parts that are levered: its tables and its weights file.
//!
//! Propagation as of pushes, on nodes that are the cuboids of a levered body and relations that are
//! joints between them and nearness of others. Even and odd are meant under a mirror along the levered
//! edge, in the lever frame (x inward, y along the edge, z up).

use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};

use crate::checksum::{checksum, extend};

use super::{
    Config, Normaliser, Parameters, Tables, WeightsError, layout_of,
    tensors::{decode_parameters, encode_parameters, file_metadata},
    weights::{check_normaliser, check_parameters},
};

/// Columns of its tables. What is read from a node is how the body moves: of ways x and z and of the
/// turn y are even, of ways y and of the turn x and z are odd.
pub const PARTS: Tables = Tables { node: [19, 13], relation: [24, 8], output: [3, 3] };

/// Version of the feature layout and file format; a file of another version is refused.
const FORMAT: u32 = 1;

/// Key of the card in the file's metadata.
const KEY: &str = "pushplan-parts";

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartsCard {
    /// Network size.
    pub config: Config,
    /// Whether it corrects the prior.
    pub prior: bool,
    /// Feature scales.
    pub normaliser: Normaliser,
    /// Lever-ups that it was trained on.
    pub episodes: u64,
    /// Optimiser steps taken.
    pub steps: u64,
}

/// A card and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct PartsWeights {
    /// What they are.
    pub card: PartsCard,
    /// Their values.
    pub parameters: Parameters,
}

/// The text of the metadata.
#[derive(Serialize, Deserialize)]
struct Header {
    format: u32,
    checksum: String,
    card: PartsCard,
}

/// What is read first of it: a header of another format may have other keys.
#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

impl PartsWeights {
    /// Whether a file's bytes are of this kind, damaged or not.
    pub fn are_in(bytes: &[u8]) -> bool {
        file_metadata(bytes, KEY).is_ok_and(|text| text.is_some())
    }

    /// The file's bytes; the same weights give the same bytes.
    ///
    /// # Errors
    /// If a parameter's length does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WeightsError> {
        let header = Header { format: FORMAT, checksum: self.checksum()?, card: self.card.clone() };
        let header = serde_json::to_string(&header)?;
        let layout = layout_of(&PARTS, &self.card.config);
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
        let Config { width, steps } = card.config;
        if !(2..=4096).contains(&width) || width % 2 != 0 || !(1..=16).contains(&steps) {
            return Err(WeightsError::Size { width, steps });
        }
        check_normaliser(&card.normaliser, &PARTS)?;
        let file = SafeTensors::deserialize(bytes)?;
        let parameters = decode_parameters(&file, &layout_of(&PARTS, &card.config), "")?;
        check_parameters(&parameters)?;
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
