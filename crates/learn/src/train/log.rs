//! Log of a run, one JSON line per evaluation: `metrics.jsonl`.

use std::fmt::{self, Display};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use pushplan::internals::asset::write_atomic;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use super::TrainError;

/// Line of `metrics.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line<Score> {
    /// Number of steps taken.
    pub step: u64,
    /// Mean loss since the last line.
    pub loss: f64,
    /// Mean gradient norm before clipping since the last line.
    pub gradient: f64,
    /// Learning rate.
    pub learning_rate: f64,
    /// Number of examples per second since the last line.
    pub examples_per_second: f64,
    /// Wall time of this process so far, seconds.
    pub seconds: f64,
    /// Held-out score of the averaged weights.
    pub held_out: Score,
}

/// Summary for the progress display.
impl<Score: Display> Display for Line<Score> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { step, loss, examples_per_second, held_out, .. } = self;
        write!(
            f,
            "step {step:>7}  loss {loss:.4}  held out: {held_out}  \
             {examples_per_second:.0} examples/s"
        )
    }
}

/// Open log file, without lines after the checkpoint from which a run resumes.
pub(super) struct Log {
    path: PathBuf,
    file: fs::File,
}

impl Log {
    /// Opens the log of a run that resumes at `step`. Every line contains its `step`.
    pub fn open(folder: &Path, step: u64) -> Result<Self, TrainError> {
        let path = folder.join("metrics.jsonl");
        let until = |line: &str| {
            let line: Option<Json> = serde_json::from_str(line).ok();
            line.and_then(|line| line["step"].as_u64()).is_some_and(|of| of <= step)
        };
        let kept: String = fs::read_to_string(&path)
            .unwrap_or_default()
            .lines()
            .filter(|line| until(line))
            .flat_map(|line| [line, "\n"])
            .collect();
        write_atomic(&path, kept.as_bytes())?;
        let file = fs::OpenOptions::new()
            .append(true)
            .open(&path)
            .map_err(|e| TrainError::File(path.clone(), e))?;
        Ok(Self { path, file })
    }

    pub fn write(&mut self, line: &impl Serialize) -> Result<(), TrainError> {
        // A line contains only finite numbers and text, so encoding never fails.
        let text = serde_json::to_string(line).unwrap_or_default();
        writeln!(self.file, "{text}").map_err(|e| TrainError::File(self.path.clone(), e))
    }
}
