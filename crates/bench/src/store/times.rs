//! Wall times of a run, `times.jsonl`. They are separate from the records because they differ
//! between runs.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use pushplan::asset::write_atomic;
use pushplan::plain_file;

use super::error::StoreError;

/// Name of the file.
pub(super) const TIMES: &str = "times.jsonl";

/// Wall times of a task by stage, seconds.
pub type Seconds = BTreeMap<String, f64>;

/// Line of the file.
#[derive(Serialize, Deserialize)]
pub(super) struct TimesLine {
    pub index: usize,
    pub seconds: Seconds,
}

/// Time file, open for appending.
#[derive(Debug)]
pub(super) struct Times {
    file: File,
    path: PathBuf,
}

impl Times {
    /// Opens the file after the `kept` lines; other content, left by a crash, is dropped.
    pub fn open(dir: &Path, kept: &[String]) -> Result<Self, StoreError> {
        let path = dir.join(TIMES);
        write_atomic(&path, kept.concat().as_bytes()).map_err(StoreError::Write)?;
        let file = plain_file::open_to_write(&path, OpenOptions::new().append(true))
            .map_err(StoreError::io("write", &path))?;
        Ok(Self { file, path })
    }

    pub fn append(&mut self, line: &str) -> Result<(), StoreError> {
        self.file
            .write_all(format!("{line}\n").as_bytes())
            .and_then(|()| self.file.sync_data())
            .map_err(StoreError::io("write", &self.path))
    }
}

/// Returns the times of a folder's run, with their lines. Unreadable lines are omitted because no
/// result depends on them.
pub(super) fn read_times(dir: &Path) -> Result<Vec<(TimesLine, String)>, StoreError> {
    let path = dir.join(TIMES);
    let bytes = match plain_file::read(&path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(StoreError::io("read", &path)(error)),
    };
    let text = String::from_utf8_lossy(&bytes);
    let lines = text.split_inclusive('\n').filter(|line| line.ends_with('\n'));
    let read = |line: &str| Some((serde_json::from_str(line).ok()?, line.to_owned()));
    Ok(lines.filter_map(read).collect())
}
