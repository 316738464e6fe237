//! Everything that a run needs to resume bit-exactly, in one safetensors file.

use pushplan::internals::network::{
    Normaliser, ParameterError, decode_parameters, encode_parameters, file_metadata, layout,
};
use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::dataset::DatasetConfig;

use super::{AdamW, HeldOutError, Settings};

/// Key of the header in the file's metadata.
const KEY: &str = "pushplan-checkpoint";

/// Why a checkpoint cannot be used.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// Not a safetensors file.
    #[error("not a checkpoint: {0}")]
    Format(#[from] safetensors::SafeTensorError),
    /// The header cannot be read.
    #[error("the checkpoint's header is damaged: {0}")]
    Header(#[from] serde_json::Error),
    /// No header.
    #[error("a safetensors file, but not a checkpoint of pushplan")]
    Foreign,
    /// A tensor is missing, of a wrong shape or not finite.
    #[error("the checkpoint is damaged: {0}")]
    Tensor(#[from] ParameterError),
    /// Resuming would mix two runs.
    #[error("the checkpoint belongs to a run with other {0}; choose another folder")]
    Other(&'static str),
}

/// The state of a run after some step. Batches and noise are functions of (seed, step), so
/// there is no generator to save.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// What decides the run.
    pub settings: Settings,
    /// What decides its data.
    pub data: DatasetConfig,
    /// Feature scales.
    pub normaliser: Normaliser,
    /// Weights, moments and average.
    pub optimiser: AdamW,
    /// Lowest held-out error so far.
    pub best: Option<HeldOutError>,
}

#[derive(Serialize, Deserialize)]
struct Header {
    settings: Settings,
    data: DatasetConfig,
    normaliser: Normaliser,
    step: u64,
    best: Option<HeldOutError>,
}

impl Checkpoint {
    /// The file's bytes.
    ///
    /// # Errors
    /// If a tensor does not fit its shape.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        let header = Header {
            settings: self.settings.clone(),
            data: self.data.clone(),
            normaliser: self.normaliser.clone(),
            step: self.optimiser.step,
            best: self.best.clone(),
        };
        let header = serde_json::to_string(&header)?;
        let groups = [
            ("weights/", &self.optimiser.weights),
            ("first/", &self.optimiser.first),
            ("second/", &self.optimiser.second),
            ("average/", &self.optimiser.average),
        ];
        Ok(encode_parameters(&layout(&self.settings.config), &groups, (KEY, header))?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`CheckpointError`] if they are not a complete checkpoint.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CheckpointError> {
        let text = file_metadata(bytes, KEY)?.ok_or(CheckpointError::Foreign)?;
        let header: Header = serde_json::from_str(&text)?;
        let file = SafeTensors::deserialize(bytes)?;
        let group =
            |prefix: &str| decode_parameters(&file, &layout(&header.settings.config), prefix);
        let optimiser = AdamW {
            weights: group("weights/")?,
            first: group("first/")?,
            second: group("second/")?,
            average: group("average/")?,
            step: header.step,
        };
        Ok(Self {
            settings: header.settings,
            data: header.data,
            normaliser: header.normaliser,
            optimiser,
            best: header.best,
        })
    }

    /// Refuses to go on under other settings or data than those the run began with. A longer
    /// schedule is another run, too: its learning rates would have differed from the start.
    ///
    /// # Errors
    /// [`CheckpointError::Other`].
    pub fn fits(&self, settings: &Settings, data: &DatasetConfig) -> Result<(), CheckpointError> {
        if self.settings != *settings {
            return Err(CheckpointError::Other("settings"));
        }
        if self.data.split(0, data.episodes) != data.split(0, data.episodes)
            || self.data.seed != data.seed
            || self.data.episodes != data.episodes
        {
            return Err(CheckpointError::Other("data"));
        }
        Ok(())
    }
}
