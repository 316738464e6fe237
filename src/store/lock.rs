//! One writer at a time in a folder.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use super::error::StoreError;

/// Keeps other processes from writing to a folder, as long as it lives; the system frees the
/// folder of a process that was killed. It leaves no file behind.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    _folder: Option<File>,
}

impl FolderLock {
    /// Makes the folder if there is none, and locks it.
    ///
    /// # Errors
    /// [`StoreError::Busy`] if another process has locked it, [`StoreError::Io`] if it cannot be
    /// made.
    pub fn take(dir: &Path) -> Result<Self, StoreError> {
        fs::create_dir_all(dir).map_err(StoreError::io("create", dir))?;
        // Some systems cannot open a folder, and some network file systems know no locks; the
        // run is then as safe as without one.
        let folder = File::open(dir).ok();
        match folder.as_ref().map(File::try_lock) {
            Some(Err(TryLockError::WouldBlock)) => Err(StoreError::Busy { path: dir.to_owned() }),
            _ => Ok(Self { path: dir.to_owned(), _folder: folder }),
        }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }
}
