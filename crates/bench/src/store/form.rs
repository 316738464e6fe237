//! File formats of records.

use std::io::{self, BufRead, Read};
use std::path::Path;

use pushplan::checksum::checksum;

/// File format of a run's records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `records.jsonl`, a line of JSON each, readable by people and other programs.
    Lines,
    /// `records.bin`, for large data: length `u32`, the record, its checksum `u64`, little-endian.
    Frames,
}

/// Result of reading the next record of a file.
pub(super) enum Next {
    /// Record, with the bytes passed to [`Form::frame`].
    Record(Vec<u8>),
    /// Incomplete record; the bytes behind it are ignored.
    Torn,
    /// End of the file.
    End,
}

impl Form {
    /// Returns the format of the run in a folder; [`Form::Lines`] if it has no records.
    pub fn of(dir: &Path) -> Self {
        if dir.join(Form::Frames.file()).exists() { Form::Frames } else { Form::Lines }
    }

    /// Returns the name of the file.
    pub fn file(self) -> &'static str {
        match self {
            Form::Lines => "records.jsonl",
            Form::Frames => "records.bin",
        }
    }

    /// Encodes a record for the file; a record of [`Form::Lines`] must not contain a line feed.
    pub(super) fn frame(self, record: &[u8]) -> Vec<u8> {
        match self {
            Form::Lines => [record, b"\n"].concat(),
            Form::Frames => {
                // Records contain one episode or task each, far below the limit of four bytes.
                let length = u32::try_from(record.len()).unwrap_or(u32::MAX);
                [&length.to_le_bytes(), record, &checksum(record).to_le_bytes()].concat()
            }
        }
    }

    /// Reads the next record of `file`.
    pub(super) fn next(self, file: &mut impl BufRead) -> io::Result<Next> {
        if file.fill_buf()?.is_empty() {
            return Ok(Next::End);
        }
        let mut record = Vec::new();
        match self {
            Form::Lines => {
                file.read_until(b'\n', &mut record)?;
                Ok(if record.pop_if(|last| *last == b'\n').is_some() {
                    Next::Record(record)
                } else {
                    Next::Torn
                })
            }
            Form::Frames => {
                let Some(length) = array(file)?.map(u32::from_le_bytes) else {
                    return Ok(Next::Torn);
                };
                // The buffer grows while reading, so that a wrong length allocates at most the size
                // of the file.
                file.take(u64::from(length)).read_to_end(&mut record)?;
                let sum = array(file)?.map(u64::from_le_bytes);
                let whole = record.len() == length as usize && sum == Some(checksum(&record));
                Ok(if whole { Next::Record(record) } else { Next::Torn })
            }
        }
    }
}

/// Reads the next bytes of a file; returns `None` if there are too few.
fn array<const N: usize>(file: &mut impl BufRead) -> io::Result<Option<[u8; N]>> {
    let mut bytes = Vec::with_capacity(N);
    file.take(N as u64).read_to_end(&mut bytes)?;
    Ok(bytes.try_into().ok())
}
