//! Checkpoint of a run in one safetensors file, for bit-exact resumption.

use pushplan::internals::network::{
    Card, Layout, ParameterError, Parameters, decode_parameters, encode_parameters, file_metadata,
};
use safetensors::SafeTensors;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{AdamW, Trainable};

/// Error of reading or writing a checkpoint.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// The file is no safetensors file.
    #[error("not a checkpoint: {0}")]
    Format(#[from] safetensors::SafeTensorError),
    /// The header is unreadable.
    #[error("the header of the checkpoint is damaged: {0}")]
    Header(#[from] serde_json::Error),
    /// The header is missing.
    #[error("a safetensors file, but not a checkpoint of this network")]
    Foreign,
    /// A tensor is missing, of a wrong shape, or not finite.
    #[error("the checkpoint is damaged: {0}")]
    Tensor(#[from] ParameterError),
    /// The checkpoint belongs to another run. A longer schedule is also another run because its
    /// learning rates differ from the start.
    #[error("the checkpoint belongs to a run with other settings or data; choose another folder")]
    Other,
}

/// State of a run after some step. Batches and noise depend only on (seed, step), so no generator
/// is saved.
pub struct Checkpoint<T: Trainable> {
    /// Feature scales.
    pub scales: T::Scales,
    /// Weights, moments and average.
    pub optimiser: AdamW,
    /// Weights for the rollouts from which examples are taken, if any.
    pub lead: Option<Parameters>,
    /// Best held-out score so far.
    pub best: Option<T::Score>,
}

/// Header in the file's metadata.
#[derive(Serialize, Deserialize)]
struct Header<Settings, Scales, Score> {
    settings: Settings,
    scales: Scales,
    step: u64,
    lead: bool,
    best: Option<Score>,
}

impl<T: Trainable> Checkpoint<T> {
    /// Returns the checkpoint of a new run.
    pub fn fresh(task: &T) -> Self {
        let scales = task.scales();
        let optimiser = AdamW::new(task.fresh(&scales));
        Self { scales, optimiser, lead: None, best: None }
    }

    /// Encodes the checkpoint.
    ///
    /// # Errors
    /// Returns an error if a tensor does not fit its shape.
    pub fn to_bytes(&self, task: &T) -> Result<Vec<u8>, CheckpointError> {
        let Self { scales, optimiser, lead, best } = self;
        let (step, best) = (optimiser.step, best.as_ref());
        let header = Header { settings: task.settings(), scales, step, lead: lead.is_some(), best };
        let mut groups = vec![
            ("weights/", &optimiser.weights),
            ("first/", &optimiser.first),
            ("second/", &optimiser.second),
            ("average/", &optimiser.average),
        ];
        groups.extend(lead.iter().map(|lead| ("lead/", lead)));
        let text = serde_json::to_string(&header)?;
        Ok(encode_parameters(&layout(task, scales), &groups, (T::KEY, text))?)
    }

    /// Decodes a checkpoint.
    ///
    /// # Errors
    /// Returns [`CheckpointError`] if the bytes are no complete checkpoint or belong to another
    /// run.
    pub fn from_bytes(task: &T, bytes: &[u8]) -> Result<Self, CheckpointError> {
        let text = file_metadata(bytes, T::KEY)?.ok_or(CheckpointError::Foreign)?;
        let header: Header<T::Settings, T::Scales, T::Score> = serde_json::from_str(&text)?;
        if header.settings != task.settings() {
            return Err(CheckpointError::Other);
        }
        let Header { scales, step, lead, best, .. } = header;
        let file = SafeTensors::deserialize(bytes)?;
        let layout = layout(task, &scales);
        let group = |prefix: &str| decode_parameters(&file, &layout, prefix);
        let optimiser = AdamW {
            weights: group("weights/")?,
            first: group("first/")?,
            second: group("second/")?,
            average: group("average/")?,
            step,
        };
        let lead = lead.then(|| group("lead/")).transpose()?;
        Ok(Self { scales, optimiser, lead, best })
    }
}

fn layout<T: Trainable>(task: &T, scales: &T::Scales) -> Layout {
    task.card(scales, 0, None).layout()
}
