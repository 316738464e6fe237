//! Everything that a run needs to go on to the bit, in one safetensors file.

use std::collections::HashMap;

use safetensors::{Dtype, SafeTensors, tensor::TensorView};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{
    brdpn::{Normaliser, Parameters, layout},
    dataset::DatasetConfig,
};

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
    /// A tensor is missing or wrong.
    #[error("the checkpoint's `{0}` is missing, has a wrong shape or is not finite")]
    Tensor(String),
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
        let shapes = layout(&self.settings.config);
        let mut raw: Vec<(String, Vec<usize>, Vec<u8>)> = Vec::new();
        for (group, parameters) in self.groups() {
            for (name, shape) in &shapes {
                let values = parameters.values.get(*name).map_or(&[][..], Vec::as_slice);
                let bytes = values.iter().flat_map(|x| x.to_le_bytes()).collect();
                raw.push((format!("{group}/{name}"), shape.clone(), bytes));
            }
        }
        let views = raw
            .iter()
            .map(|(name, shape, bytes)| {
                Ok((name.as_str(), TensorView::new(Dtype::F32, shape.clone(), bytes)?))
            })
            .collect::<Result<Vec<_>, CheckpointError>>()?;
        let header = Header {
            settings: self.settings.clone(),
            data: self.data.clone(),
            normaliser: self.normaliser.clone(),
            step: self.optimiser.step,
            best: self.best.clone(),
        };
        let metadata = HashMap::from([(KEY.to_owned(), serde_json::to_string(&header)?)]);
        Ok(safetensors::serialize(views, Some(metadata))?)
    }

    /// Reads a file's bytes.
    ///
    /// # Errors
    /// [`CheckpointError`] if they are not a complete checkpoint.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CheckpointError> {
        let (_, metadata) = SafeTensors::read_metadata(bytes)?;
        let text = metadata.metadata().as_ref().and_then(|m| m.get(KEY));
        let header: Header = serde_json::from_str(text.ok_or(CheckpointError::Foreign)?)?;
        let file = SafeTensors::deserialize(bytes)?;
        let shapes = layout(&header.settings.config);
        let group = |group: &str| -> Result<Parameters, CheckpointError> {
            let mut parameters = Parameters::default();
            for (name, shape) in &shapes {
                let key = format!("{group}/{name}");
                let wrong = || CheckpointError::Tensor(key.clone());
                let view = file.tensor(&key).map_err(|_| wrong())?;
                if view.dtype() != Dtype::F32 || view.shape() != shape.as_slice() {
                    return Err(wrong());
                }
                let values: Vec<f32> = view
                    .data()
                    .chunks_exact(4)
                    .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
                    .collect();
                if values.iter().any(|x| !x.is_finite()) {
                    return Err(wrong());
                }
                parameters.values.insert((*name).to_owned(), values);
            }
            Ok(parameters)
        };
        let optimiser = AdamW {
            weights: group("weights")?,
            first: group("first")?,
            second: group("second")?,
            average: group("average")?,
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

    fn groups(&self) -> [(&'static str, &Parameters); 4] {
        [
            ("weights", &self.optimiser.weights),
            ("first", &self.optimiser.first),
            ("second", &self.optimiser.second),
            ("average", &self.optimiser.average),
        ]
    }
}
