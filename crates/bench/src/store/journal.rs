//! Journal of a run's records on disk. Each record is synced before the next is appended, and a
//! torn end is dropped.

use std::fs::{File, OpenOptions};
use std::io::{BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};

use pushplan::plain_file;
use pushplan::progress::Progress;

use super::error::StoreError;
use super::form::{Form, Next};
use super::lock::FolderLock;
use super::manifest::RunManifest;

/// Callback that decodes a record and returns its index, or a description of the error.
pub type Look<'a> = dyn FnMut(&[u8]) -> Result<usize, String> + 'a;

/// Journal of a run, which holds the folder's lock.
#[derive(Debug)]
pub struct Journal {
    form: Form,
    path: PathBuf,
    file: File,
    done: usize,
    bytes: u64,
    _lock: FolderLock,
}

impl Journal {
    /// Creates a run in the folder `dir`, or resumes the existing one: `look` receives its records,
    /// in order. A torn end is dropped with a note to `progress`.
    ///
    /// # Errors
    /// Returns an error if the folder holds a run with another manifest (the error lists the
    /// differences) or a damaged one. Other errors are a lock of another process, and a folder that
    /// cannot be written.
    pub fn open(
        dir: &Path,
        manifest: RunManifest,
        form: Form,
        progress: &dyn Progress,
        look: &mut Look,
    ) -> Result<Self, StoreError> {
        let lock = FolderLock::take(dir, progress)?;
        let path = dir.join(form.file());
        match RunManifest::load(dir)? {
            Some(there) if there != manifest => {
                let differences = there.differences(&manifest);
                return Err(StoreError::OtherRun { path: dir.to_owned(), differences });
            }
            Some(_) => {}
            None if path.exists() => return Err(StoreError::Stray { path: dir.to_owned() }),
            None => manifest.save(dir)?,
        }
        let read = read_records(dir, &manifest, form, look)?;
        let file = plain_file::open_to_write(&path, OpenOptions::new().append(true).create(true))
            .map_err(StoreError::io("write", &path))?;
        if read.torn {
            progress.note(&format!(
                "{} is incomplete after record {}; later records are computed again",
                path.display(),
                read.count
            ));
            file.set_len(read.bytes).map_err(StoreError::io("shorten", &path))?;
        }
        Ok(Self { form, path, file, done: read.count, bytes: read.bytes, _lock: lock })
    }

    /// Returns the number of finished records.
    pub fn done(&self) -> usize {
        self.done
    }

    /// Returns the length of the finished records, bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Appends the next records.
    ///
    /// # Errors
    /// Returns an error if they cannot be written; earlier records are kept.
    pub fn append<'a>(
        &mut self,
        records: impl IntoIterator<Item = &'a [u8]>,
    ) -> Result<(), StoreError> {
        let mut bytes = Vec::new();
        let mut count = 0;
        for record in records {
            bytes.extend(self.form.frame(record));
            count += 1;
        }
        self.file
            .write_all(&bytes)
            .and_then(|()| self.file.sync_data())
            .map_err(StoreError::io("write", &self.path))?;
        self.done += count;
        self.bytes += bytes.len() as u64;
        Ok(())
    }
}

/// Summary of a record file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held {
    /// Number of complete records.
    pub count: usize,
    /// Length of the complete records, bytes.
    pub bytes: u64,
    /// Whether an incomplete record follows.
    pub torn: bool,
}

/// Passes the records of a folder's run to `look`, in order, without writing. A torn end is
/// omitted.
///
/// # Errors
/// Returns an error if any other record does not match the task of `manifest` at its position.
pub fn read_records(
    dir: &Path,
    manifest: &RunManifest,
    form: Form,
    look: &mut Look,
) -> Result<Held, StoreError> {
    let path = dir.join(form.file());
    let mut held = Held { count: 0, bytes: 0, torn: false };
    let mut file = match plain_file::open(&path) {
        Ok(file) => BufReader::new(file),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(held),
        Err(error) => return Err(StoreError::io("read", &path)(error)),
    };
    let mut next = || form.next(&mut file).map_err(StoreError::io("read", &path));
    let mut indices = manifest.indices();
    let mut coming = next()?;
    loop {
        let record = match coming {
            Next::Record(record) => record,
            Next::Torn => return Ok(Held { torn: true, ..held }),
            Next::End => return Ok(held),
        };
        coming = next()?;
        let damaged = |why| StoreError::Damaged { path: path.clone(), record: held.count + 1, why };
        let wanted = indices.next();
        match look(&record) {
            Ok(index) if Some(index) == wanted => {}
            Ok(index) => {
                let wanted = wanted.map_or("the end".to_owned(), |index| format!("record {index}"));
                return Err(damaged(format!("record {index} instead of {wanted}")));
            }
            // After a crash, some blocks of the last record may be missing on disk.
            Err(_) if matches!(coming, Next::End) => return Ok(Held { torn: true, ..held }),
            Err(why) => return Err(damaged(why)),
        }
        held.count += 1;
        held.bytes += form.frame(&record).len() as u64;
    }
}
