//! `metrics.jsonl`, without lines past the checkpoint that a run goes on from.

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

use serde::Serialize;
use serde_json::Value as Json;

use pushplan::internals::asset::write_atomic;

use super::TrainError;

/// The open file.
pub(super) struct Log {
    path: PathBuf,
    file: fs::File,
}

impl Log {
    /// Opens that of a run that goes on from `step`; every line says its `step`.
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
        // A metric line holds only finite numbers and text, which always encode.
        let text = serde_json::to_string(line).unwrap_or_default();
        writeln!(self.file, "{text}").map_err(|e| TrainError::File(self.path.clone(), e))
    }
}
