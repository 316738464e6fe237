//! The weights file of a network of lever-ups: parameters with everything needed to use and to judge them.

use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};

use crate::{
    checksum::{checksum, extend},
    network::{
        Parameters, Statistics, WeightsError,
        normaliser::MIN_DEVIATION,
        tensors::{ParameterError, decode_parameters, encode_parameters, file_metadata},
    },
    scene::LeverFeatures,
};

use super::image::ImageSizes;
use super::layout::{LeverSizes, lever_layout};

/// Version of the feature layout and file format; a file of another version is refused.
const FORMAT: u32 = 1;

/// Key of the card in the file's metadata.
const KEY: &str = "pushplan-lever";

/// Largest magnitude of a parameter, a mean or a deviation.
const LARGEST: f32 = 1e3;

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverCard {
    /// What it is told of the shape.
    pub features: LeverFeatures,
    /// Whether it corrects the prior.
    pub prior: bool,
    /// Widths.
    pub sizes: LeverSizes,
    /// Scales of features of a lever-up.
    pub still: Statistics,
    /// Scales of features of a frame.
    pub moving: Statistics,
    /// Lever-ups that it was trained on.
    pub episodes: u64,
    /// Optimiser steps taken.
    pub steps: u64,
}

/// A card and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverWeights {
    /// What they are.
    pub card: LeverCard,
    /// Their values.
    pub parameters: Parameters,
}

/// The text of the metadata.
#[derive(Serialize, Deserialize)]
struct Header {
    format: u32,
    checksum: String,
    card: LeverCard,
}

/// What is read first of it: a header of another format may have other keys.
#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

impl LeverWeights {
    /// The file's bytes; the same weights give the same bytes.
    ///
    /// # Errors
    /// If a parameter's length does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WeightsError> {
        let header = Header { format: FORMAT, checksum: self.checksum()?, card: self.card.clone() };
        let header = serde_json::to_string(&header)?;
        let layout = lever_layout(&self.card.sizes);
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
        let LeverSizes { still, moving, width, image, .. } = card.sizes;
        let too_large = |image: &ImageSizes| {
            image.rows.max(image.columns) > ImageSizes::MOST || !(1..=4096).contains(&image.code)
        };
        if [still, moving, width].iter().any(|size| !(1..=4096).contains(size))
            || image.as_ref().is_some_and(too_large)
        {
            return Err(WeightsError::Size { width, steps: 1 });
        }
        for (name, scales, count) in
            [("still", &card.still, still), ("moving", &card.moving, moving)]
        {
            for (values, least) in [(&scales.mean, -LARGEST), (&scales.deviation, MIN_DEVIATION)] {
                if values.len() != count || values.iter().any(|x| !(least..=LARGEST).contains(x)) {
                    let fault = "has a wrong length or an impossible value";
                    return Err(ParameterError { name: name.to_owned(), fault }.into());
                }
            }
        }
        let file = SafeTensors::deserialize(bytes)?;
        let parameters = decode_parameters(&file, &lever_layout(&card.sizes), "")?;
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
