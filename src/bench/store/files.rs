//! The lines of a run on disk: appended one by one, each flushed to the disk; a torn last line
//! is dropped, never trusted.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::asset::write_atomic;

use super::{error::StoreError, manifest::RunManifest, run::Seconds};

/// Name of the records' file.
pub(super) const RECORDS: &str = "records.jsonl";

/// Name of the times' file.
pub(super) const TIMES: &str = "times.jsonl";

/// A line of the records' file.
#[derive(Serialize, Deserialize)]
pub(super) struct RecordLine<R> {
    pub index: usize,
    pub record: R,
}

/// A line of the times' file.
#[derive(Serialize, Deserialize)]
pub(super) struct TimesLine {
    pub index: usize,
    pub seconds: Seconds,
}

/// What a file of lines holds.
pub(super) struct Lines {
    /// The whole lines, each with its newline.
    pub whole: Vec<String>,
    /// Whether bytes that are no whole line follow.
    pub torn: bool,
}

/// The files of a run that is being written. Holds a lock against a second writer.
#[derive(Debug)]
pub(super) struct Files {
    records: File,
    times: File,
    paths: [PathBuf; 2],
}

impl Files {
    /// Opens both files for appending, after their first `records` and `times`.
    pub fn open(dir: &Path, records: &Lines, times: &[String]) -> Result<Self, StoreError> {
        let paths = [RECORDS, TIMES].map(|name| dir.join(name));
        let append = |path: &PathBuf| {
            OpenOptions::new()
                .append(true)
                .create(true)
                .open(path)
                .map_err(|source| StoreError::Io { doing: "write", path: path.clone(), source })
        };
        let file = append(&paths[0])?;
        lock(&file, dir)?;
        if records.torn {
            let bytes = records.whole.iter().map(String::len).sum::<usize>() as u64;
            file.set_len(bytes).map_err(|source| StoreError::Io {
                doing: "shorten",
                path: paths[0].clone(),
                source,
            })?;
        }
        // Times are few bytes; writing them anew drops whatever a crash left behind.
        write_atomic(&paths[1], times.concat().as_bytes()).map_err(StoreError::Write)?;
        let times = append(&paths[1])?;
        Ok(Self { records: file, times, paths })
    }

    /// Appends a task: its times first, so that every record has some.
    pub fn append(&mut self, record: &str, times: &str) -> Result<(), StoreError> {
        let files =
            [(&mut self.times, times, &self.paths[1]), (&mut self.records, record, &self.paths[0])];
        for (file, line, path) in files {
            file.write_all(line.as_bytes())
                .and_then(|()| file.sync_data())
                .map_err(|source| StoreError::Io { doing: "write", path: path.clone(), source })?;
        }
        Ok(())
    }
}

/// The records of a folder's run as raw lines: those of the first tasks of `manifest`, in
/// order. A last line that is not whole is left out.
///
/// # Errors
/// If any other line is not the record that belongs there.
pub(super) fn read_records<R: for<'a> Deserialize<'a>>(
    dir: &Path,
    manifest: &RunManifest,
) -> Result<(Lines, Vec<R>), StoreError> {
    let path = dir.join(RECORDS);
    let mut lines = read_lines(&path)?;
    let mut indices = manifest.indices();
    let mut records = Vec::with_capacity(lines.whole.len());
    for (k, line) in lines.whole.iter().enumerate() {
        let damaged = |why| StoreError::Damaged { path: path.clone(), line: k + 1, why };
        let wanted = indices.next();
        match serde_json::from_str::<RecordLine<R>>(line) {
            Ok(read) if Some(read.index) == wanted => records.push(read.record),
            Ok(read) => {
                let wanted = wanted.map_or("no more".to_owned(), |index| format!("task {index}"));
                return Err(damaged(format!("task {} where {wanted} belongs", read.index)));
            }
            // A crash may leave a last line of which not all blocks reached the disk.
            Err(_) if k + 1 == lines.whole.len() && !lines.torn => break,
            Err(error) => return Err(damaged(error.to_string())),
        }
    }
    lines.torn |= records.len() < lines.whole.len();
    lines.whole.truncate(records.len());
    Ok((lines, records))
}

/// The times of a folder's run, with their lines; what cannot be read is left out, as no result
/// depends on it.
pub(super) fn read_times(dir: &Path) -> Result<Vec<(TimesLine, String)>, StoreError> {
    let lines = read_lines(&dir.join(TIMES))?.whole.into_iter();
    Ok(lines.filter_map(|line| Some((serde_json::from_str(&line).ok()?, line))).collect())
}

/// A value as one line.
pub(super) fn line(value: &impl Serialize) -> Result<String, serde_json::Error> {
    serde_json::to_string(value).map(|text| text + "\n")
}

fn read_lines(path: &Path) -> Result<Lines, StoreError> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Vec::new(),
        Err(source) => return Err(StoreError::Io { doing: "read", path: path.to_owned(), source }),
    };
    // What is not UTF-8 becomes a line that is no JSON and is judged as such.
    let mut whole: Vec<String> = bytes
        .split_inclusive(|byte| *byte == b'\n')
        .map(|line| String::from_utf8_lossy(line).into_owned())
        .collect();
    let torn = whole.pop_if(|last| !last.ends_with('\n')).is_some();
    Ok(Lines { whole, torn })
}

/// Keeps a second process from writing to the same run, where the file system can.
fn lock(file: &File, dir: &Path) -> Result<(), StoreError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(StoreError::Busy { path: dir.to_owned() }),
        // Some network file systems know no locks; the run is then as safe as without one.
        Err(TryLockError::Error(_)) | Ok(()) => Ok(()),
    }
}
