//! Exclusive write access to a folder.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};

use pushplan::plain_file;
use pushplan::progress::Progress;

use super::error::StoreError;

/// Name of the lock file, which exists while a process writes to the folder.
const LOCK: &str = ".pushplan-lock";

/// Lock that keeps other processes from writing to a folder; the system releases it if the process
/// is killed.
///
/// The lock is on a file instead of the folder, because network file systems lock only files opened
/// for writing. The file contains the name of the writer and is removed with the lock.
#[derive(Debug)]
pub struct FolderLock {
    folder: PathBuf,
    /// Dropped after the removal of the file, so that no process locks a file that is about to be
    /// removed.
    _file: File,
}

impl FolderLock {
    /// Creates the folder if it does not exist, and locks it. If the file system does not support
    /// locks, or not across machines, `progress` receives a note.
    ///
    /// # Errors
    /// Returns [`StoreError::Busy`] if another process holds the lock, and [`StoreError::Io`] if
    /// the folder cannot be created or written, or if the lock is a symbolic link.
    pub fn take(dir: &Path, progress: &dyn Progress) -> Result<Self, StoreError> {
        fs::create_dir_all(dir).map_err(StoreError::io("create", dir))?;
        let path = dir.join(LOCK);
        loop {
            // The file is not truncated because it contains the name of the writer.
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let mut file = plain_file::open_to_write(&path, &options)
                .map_err(StoreError::io("write", &path))?;
            let locked = file.try_lock();
            let before = writer(&mut file);
            match locked {
                Ok(()) if !is_at(&file, &path) => continue,
                Ok(()) => note_another_machine(dir, before, progress),
                Err(TryLockError::WouldBlock) => {
                    return Err(StoreError::Busy { path: dir.to_owned(), writer: before });
                }
                Err(TryLockError::Error(_)) => note_no_locks(dir, before, progress),
            }
            // The name of the writer is informative; the lock does not need it.
            let _ = file
                .set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| file.write_all(format!("{}\n", this_process()).as_bytes()));
            return Ok(Self { folder: dir.to_owned(), _file: file });
        }
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.folder
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // The file is removed while it is still locked. A remaining file locks nothing.
        let _ = fs::remove_file(self.folder.join(LOCK));
    }
}

/// Returns the process that holds the lock of a folder, or was killed while it did. The file is
/// only read, because a temporary lock could block another process.
pub(super) fn writer_of(dir: &Path) -> Option<String> {
    writer(&mut plain_file::open(&dir.join(LOCK)).ok()?)
}

/// Describes this process: `process 4711 on node-3`.
fn this_process() -> String {
    format!("process {} on {}", std::process::id(), host())
}

/// Returns the name of this machine, or of the container.
fn host() -> String {
    let kernel = fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let named = kernel.or_else(|| ["HOSTNAME", "COMPUTERNAME"].iter().find_map(variable));
    let name = named.map(|name| name.trim().to_owned()).filter(|name| !name.is_empty());
    name.unwrap_or_else(|| "an unnamed machine".to_owned())
}

fn variable(name: &&str) -> Option<String> {
    std::env::var(name).ok()
}

/// Returns the content of the lock file, if it is a line in our format.
fn writer(file: &mut File) -> Option<String> {
    let mut text = String::new();
    // The limit is longer than any host name.
    file.take(400).read_to_string(&mut text).ok()?;
    let line = text.lines().next()?;
    line.starts_with("process ").then(|| line.to_owned())
}

/// Returns `true` if the path still refers to this file. The previous holder may have removed the
/// file between our opening and our locking it.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let of = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    match (file.metadata(), fs::symlink_metadata(path)) {
        (Ok(file), Ok(there)) => of(file) == of(there),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

/// Notes a lock file with the name of another machine. Its process ended abnormally, or its lock is
/// not visible from here.
fn note_another_machine(dir: &Path, before: Option<String>, progress: &dyn Progress) {
    let here = format!(" on {}", host());
    if let Some(writer) = before.filter(|writer| !writer.ends_with(&here)) {
        progress.note(&format!(
            "{writer} was the last to write to {} and did not report its end; if it still runs, \
             stop one of the two processes, because locks of this folder do not work across machines",
            dir.display()
        ));
    }
}

fn note_no_locks(dir: &Path, before: Option<String>, progress: &dyn Progress) {
    let last = before.map_or(String::new(), |writer| format!(" (last writer: {writer})"));
    progress.note(&format!(
        "the file system of {} has no locks: make sure that only one pushplan writes there{last}",
        dir.display()
    ));
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use pushplan::progress::NoProgress;

    #[derive(Default)]
    struct Notes(Mutex<Vec<String>>);

    impl Progress for Notes {
        fn note(&self, message: &str) {
            self.0.lock().expect("notes").push(message.to_owned());
        }
    }

    #[test]
    fn the_lock_names_host_and_process_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let lock = FolderLock::take(folder.path(), &NoProgress).expect("a free folder");
        let text = fs::read_to_string(folder.path().join(LOCK)).expect("the lock");
        assert_eq!(text, format!("process {} on {}\n", std::process::id(), host()));
        let error = FolderLock::take(folder.path(), &NoProgress).expect_err("a locked folder");
        assert!(error.to_string().contains(text.trim_end()), "{error}");
        assert_eq!(writer_of(folder.path()).as_deref(), Some(text.trim_end()));
        drop(lock);
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
        assert_eq!(writer_of(folder.path()), None);
    }

    #[cfg(unix)]
    #[test]
    fn a_lock_that_is_a_link_is_refused_and_its_target_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let (own, sent) = (folder.path().join("precious"), folder.path().join("sent"));
        fs::write(&own, "precious").expect("a file");
        fs::create_dir(&sent).expect("a folder");
        std::os::unix::fs::symlink("../precious", sent.join(LOCK)).expect("a link");
        let error = FolderLock::take(&sent, &NoProgress).expect_err("a link").to_string();
        assert!(error.contains(LOCK) && error.contains("remove the link"), "{error}");
        assert_eq!(fs::read_to_string(own).expect("the file"), "precious");
    }

    #[test]
    fn a_lock_left_behind_is_taken_and_told_if_it_is_of_another_machine() {
        let folder = tempfile::tempdir().expect("a folder");
        for (left, note) in [
            (format!("process 1 on {}\n", host()), None),
            ("process 7 on elsewhere\n".to_owned(), Some("process 7 on elsewhere")),
            (String::new(), None),
            ("noise \u{1b}[2J\n".to_owned(), None),
        ] {
            fs::write(folder.path().join(LOCK), &left).expect("a file");
            let notes = Notes::default();
            drop(FolderLock::take(folder.path(), &notes).expect("a free folder"));
            let notes = notes.0.into_inner().expect("notes");
            assert_eq!(notes.len(), usize::from(note.is_some()), "{left:?}: {notes:?}");
            assert!(note.is_none_or(|note| notes[0].contains(note)), "{notes:?}");
        }
    }
}
