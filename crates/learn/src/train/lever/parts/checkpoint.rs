//! Everything that the training of a network of parts needs to resume bit-exactly.

use pushplan::internals::network::{
    Normaliser, PARTS, Parameters, decode_parameters, encode_parameters, file_metadata, layout_of,
};
use serde::{Deserialize, Serialize};

use crate::train::{AdamW, CheckpointError};

use super::super::settings::LeverScore;
use super::settings::PartsSettings;

/// Key of the header in the file's metadata.
const KEY: &str = "pushplan-parts-checkpoint";

/// The state of a run after some step. Batches are functions of (seed, step) and `lead`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Checkpoint {
    pub settings: PartsSettings,
    pub normaliser: Normaliser,
    pub optimiser: AdamW,
    /// The weights whose rollouts examples are taken from.
    pub lead: Parameters,
    /// Lowest held-out error so far.
    pub best: Option<LeverScore>,
}

#[derive(Serialize, Deserialize)]
struct Header {
    settings: PartsSettings,
    normaliser: Normaliser,
    step: u64,
    best: Option<LeverScore>,
}

impl Checkpoint {
    /// The file's bytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        let Self { settings, normaliser, optimiser, lead, best } = self;
        let (settings, normaliser) = (settings.clone(), normaliser.clone());
        let header = Header { settings, normaliser, step: optimiser.step, best: *best };
        let header = serde_json::to_string(&header)?;
        let groups = [
            ("weights/", &optimiser.weights),
            ("first/", &optimiser.first),
            ("second/", &optimiser.second),
            ("average/", &optimiser.average),
            ("lead/", lead),
        ];
        let layout = layout_of(&PARTS, &self.settings.config);
        Ok(encode_parameters(&layout, &groups, (KEY, header))?)
    }

    /// Reads a file's bytes; an error if they are not a complete checkpoint, or that of a run with other
    /// `settings`.
    pub fn from_bytes(bytes: &[u8], settings: &PartsSettings) -> Result<Self, CheckpointError> {
        let text = file_metadata(bytes, KEY)?.ok_or(CheckpointError::Foreign)?;
        let Header { settings: of, normaliser, step, best } = serde_json::from_str(&text)?;
        if of != *settings {
            return Err(CheckpointError::Other("settings"));
        }
        let layout = layout_of(&PARTS, &of.config);
        let file = safetensors::SafeTensors::deserialize(bytes)?;
        let group = |prefix: &str| decode_parameters(&file, &layout, prefix);
        let optimiser = AdamW {
            weights: group("weights/")?,
            first: group("first/")?,
            second: group("second/")?,
            average: group("average/")?,
            step,
        };
        Ok(Self { settings: of, normaliser, optimiser, lead: group("lead/")?, best })
    }
}
