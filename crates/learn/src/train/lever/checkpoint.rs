//! Everything that the training of a network of lever-ups needs to resume bit-exactly, in one safetensors file.

use pushplan::internals::network::{
    LeverSizes, Statistics, decode_parameters, encode_parameters, file_metadata, lever_layout,
};
use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};

use crate::network::autoencoder_layout;
use crate::train::{AdamW, CheckpointError};

use super::settings::{LeverScore, LeverSettings};

/// Key of the header in the file's metadata.
const KEY: &str = "pushplan-lever-checkpoint";

/// The same of an autoencoder's file.
const CODE_KEY: &str = "pushplan-lever-code-checkpoint";

/// Names and shapes of parameters.
type ShapeOf = [(&'static str, Vec<usize>)];

/// The state of a run after some step. Batches are functions of (seed, step), so there is no
/// generator to save.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverCheckpoint {
    /// What decides the run.
    pub settings: LeverSettings,
    /// Widths of the network.
    pub sizes: LeverSizes,
    /// Scales of features of a lever-up, and of a frame.
    pub scales: [Statistics; 2],
    /// Weights, moments and average.
    pub optimiser: AdamW,
    /// Lowest held-out error so far.
    pub best: Option<LeverScore>,
}

#[derive(Serialize, Deserialize)]
struct Header {
    settings: LeverSettings,
    sizes: LeverSizes,
    scales: [Statistics; 2],
    step: u64,
    best: Option<LeverScore>,
}

impl LeverCheckpoint {
    /// The file's bytes.
    ///
    /// # Errors
    /// If a tensor does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        let header = Header {
            settings: self.settings.clone(),
            sizes: self.sizes,
            scales: self.scales.clone(),
            step: self.optimiser.step,
            best: self.best,
        };
        let header = serde_json::to_string(&header)?;
        encode(&lever_layout(&self.sizes), &self.optimiser, (KEY, header))
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`CheckpointError`] if they are not a complete checkpoint, or that of a run with other
    /// `settings`.
    pub fn from_bytes(bytes: &[u8], settings: &LeverSettings) -> Result<Self, CheckpointError> {
        let text = file_metadata(bytes, KEY)?.ok_or(CheckpointError::Foreign)?;
        let header: Header = serde_json::from_str(&text)?;
        if header.settings != *settings {
            return Err(CheckpointError::Other("settings"));
        }
        let optimiser = decode(bytes, &lever_layout(&header.sizes), header.step)?;
        Ok(Self {
            settings: header.settings,
            sizes: header.sizes,
            scales: header.scales,
            optimiser,
            best: header.best,
        })
    }
}

/// The state of the autoencoder that a run begins with.
pub(super) struct CodeCheckpoint {
    pub settings: LeverSettings,
    pub optimiser: AdamW,
}

#[derive(Serialize, Deserialize)]
struct CodeHeader {
    settings: LeverSettings,
    step: u64,
}

impl CodeCheckpoint {
    /// The file's bytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        let (settings, step) = (self.settings.clone(), self.optimiser.step);
        let header = serde_json::to_string(&CodeHeader { settings, step })?;
        encode(&code_layout(&self.settings), &self.optimiser, (CODE_KEY, header))
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// As those of [`LeverCheckpoint::from_bytes`].
    pub fn from_bytes(bytes: &[u8], settings: &LeverSettings) -> Result<Self, CheckpointError> {
        let text = file_metadata(bytes, CODE_KEY)?.ok_or(CheckpointError::Foreign)?;
        let header: CodeHeader = serde_json::from_str(&text)?;
        if header.settings != *settings {
            return Err(CheckpointError::Other("settings"));
        }
        let optimiser = decode(bytes, &code_layout(settings), header.step)?;
        Ok(Self { settings: header.settings, optimiser })
    }
}

fn code_layout(settings: &LeverSettings) -> Vec<(&'static str, Vec<usize>)> {
    settings.sizes().image.as_ref().map_or(Vec::new(), autoencoder_layout)
}

fn encode(
    layout: &ShapeOf,
    optimiser: &AdamW,
    header: (&str, String),
) -> Result<Vec<u8>, CheckpointError> {
    let groups = [
        ("weights/", &optimiser.weights),
        ("first/", &optimiser.first),
        ("second/", &optimiser.second),
        ("average/", &optimiser.average),
    ];
    Ok(encode_parameters(layout, &groups, header)?)
}

fn decode(bytes: &[u8], layout: &ShapeOf, step: u64) -> Result<AdamW, CheckpointError> {
    let file = SafeTensors::deserialize(bytes)?;
    let group = |prefix: &str| decode_parameters(&file, layout, prefix);
    Ok(AdamW {
        weights: group("weights/")?,
        first: group("first/")?,
        second: group("second/")?,
        average: group("average/")?,
        step,
    })
}
