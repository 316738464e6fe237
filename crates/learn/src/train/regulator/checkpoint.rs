//! Everything that a regulator's training needs to resume bit-exactly, in one safetensors file.

use pushplan::internals::network::{
    Statistics, decode_parameters, encode_parameters, file_metadata, regulator_layout,
};
use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};

use crate::train::{AdamW, CheckpointError};

use super::{RegulatorScore, RegulatorSettings};

/// Key of the header in the file's metadata.
const KEY: &str = "pushplan-regulator-checkpoint";

/// The state of a run after some step. Batches are functions of (seed, step), so there is no
/// generator to save.
#[derive(Clone, Debug, PartialEq)]
pub struct RegulatorCheckpoint {
    /// What decides the run.
    pub settings: RegulatorSettings,
    /// Feature scales.
    pub scales: Statistics,
    /// Weights, moments and average.
    pub optimiser: AdamW,
    /// Lowest held-out negative log-likelihood so far.
    pub best: Option<RegulatorScore>,
}

#[derive(Serialize, Deserialize)]
struct Header {
    settings: RegulatorSettings,
    scales: Statistics,
    step: u64,
    best: Option<RegulatorScore>,
}

impl RegulatorCheckpoint {
    /// The file's bytes.
    ///
    /// # Errors
    /// If a tensor does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        let header = Header {
            settings: self.settings.clone(),
            scales: self.scales.clone(),
            step: self.optimiser.step,
            best: self.best,
        };
        let header = serde_json::to_string(&header)?;
        let groups = [
            ("weights/", &self.optimiser.weights),
            ("first/", &self.optimiser.first),
            ("second/", &self.optimiser.second),
            ("average/", &self.optimiser.average),
        ];
        let layout = regulator_layout(self.scales.mean.len(), self.settings.width);
        Ok(encode_parameters(&layout, &groups, (KEY, header))?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`CheckpointError`] if they are not a complete checkpoint, or that of a run with other
    /// `settings`.
    pub fn from_bytes(bytes: &[u8], settings: &RegulatorSettings) -> Result<Self, CheckpointError> {
        let text = file_metadata(bytes, KEY)?.ok_or(CheckpointError::Foreign)?;
        let header: Header = serde_json::from_str(&text)?;
        if header.settings != *settings {
            return Err(CheckpointError::Other("settings"));
        }
        let layout = regulator_layout(header.scales.mean.len(), settings.width);
        let file = SafeTensors::deserialize(bytes)?;
        let group = |prefix: &str| decode_parameters(&file, &layout, prefix);
        let optimiser = AdamW {
            weights: group("weights/")?,
            first: group("first/")?,
            second: group("second/")?,
            average: group("average/")?,
            step: header.step,
        };
        Ok(Self { settings: header.settings, scales: header.scales, optimiser, best: header.best })
    }
}
