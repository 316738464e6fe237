//! How records follow each other in their file.

use std::io::{self, BufRead, Read};
use std::path::Path;

use pushplan::checksum::checksum;

/// The file of a run's records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `records.jsonl`, a line of JSON each: for people and other programs.
    Lines,
    /// `records.bin`, for much data: length `u32`, the record, its checksum `u64`, little-endian.
    Frames,
}

/// What comes next in a file.
pub(super) enum Next {
    /// A record, as it was given to [`Form::frame`].
    Record(Vec<u8>),
    /// Bytes that are no whole record; nothing behind them is looked at.
    Torn,
    /// Nothing.
    End,
}

impl Form {
    /// That of the run in a folder; [`Form::Lines`] if it has no records.
    pub fn of(dir: &Path) -> Self {
        if dir.join(Form::Frames.file()).exists() { Form::Frames } else { Form::Lines }
    }

    /// Name of the file.
    pub fn file(self) -> &'static str {
        match self {
            Form::Lines => "records.jsonl",
            Form::Frames => "records.bin",
        }
    }

    /// A record as it stands in the file; one of [`Form::Lines`] holds no line feed.
    pub(super) fn frame(self, record: &[u8]) -> Vec<u8> {
        match self {
            Form::Lines => [record, b"\n"].concat(),
            Form::Frames => {
                // Records are of one episode or task each, far below the limit of four bytes.
                let length = u32::try_from(record.len()).unwrap_or(u32::MAX);
                [&length.to_le_bytes(), record, &checksum(record).to_le_bytes()].concat()
            }
        }
    }

    /// The next record of `file`.
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
                // Grows as it is read: a wrong length asks for no more memory than there are bytes.
                file.take(u64::from(length)).read_to_end(&mut record)?;
                let sum = array(file)?.map(u64::from_le_bytes);
                let whole = record.len() == length as usize && sum == Some(checksum(&record));
                Ok(if whole { Next::Record(record) } else { Next::Torn })
            }
        }
    }
}

/// The next bytes of a file, if there are that many.
fn array<const N: usize>(file: &mut impl BufRead) -> io::Result<Option<[u8; N]>> {
    let mut bytes = Vec::with_capacity(N);
    file.take(N as u64).read_to_end(&mut bytes)?;
    Ok(bytes.try_into().ok())
}
