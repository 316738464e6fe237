//! Opening of user files: plain files only, because a pipe or a device may never end.
//!
//! Every reader of files that users name opens them here; the test `architecture::plain_files` holds
//! it.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Error, ErrorKind, Read};
use std::path::Path;

/// Opens a plain file for reading. Symbolic links are followed.
///
/// # Errors
/// Returns an error if the file cannot be opened, or [`ErrorKind::InvalidInput`] if it is a pipe or
/// a device.
pub fn open(path: &Path) -> io::Result<File> {
    // The kind is checked first, because the opening of a pipe waits for a writer, and again
    // afterwards, because the path may have changed in between.
    plain(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    plain(&file.metadata()?)?;
    Ok(file)
}

/// Reads a plain file.
///
/// # Errors
/// Returns the errors of [`open`], and errors of reading.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Opens a plain file for writing with `options`, which must not truncate it. Symbolic links are
/// not followed, because the file that they name may belong to another user.
///
/// # Errors
/// Returns an error if the file cannot be opened, or [`ErrorKind::InvalidInput`] if it is a
/// symbolic link, a pipe or a device.
pub fn open_to_write(path: &Path, options: &OpenOptions) -> io::Result<File> {
    unlinked(path)?;
    let file = options.open(path)?;
    unlinked(path)?;
    Ok(file)
}

fn plain(metadata: &Metadata) -> io::Result<()> {
    // The system has its own error for the reading of a folder.
    match metadata.is_file() || metadata.is_dir() {
        true => Ok(()),
        false => Err(Error::new(ErrorKind::InvalidInput, "it is a pipe or a device")),
    }
}

fn unlinked(path: &Path) -> io::Result<()> {
    match fs::symlink_metadata(path) {
        Ok(there) if there.is_symlink() => {
            let what = "it is a symbolic link, which is not followed; remove the link";
            Err(Error::new(ErrorKind::InvalidInput, what))
        }
        Ok(there) => plain(&there),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(error),
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn links_are_read_through_but_not_written_through() {
        let folder = tempfile::tempdir().expect("a folder");
        let [own, link, new] = ["own", "link", "new"].map(|name| folder.path().join(name));
        fs::write(&own, "precious").expect("a file");
        symlink(&own, &link).expect("a link");
        assert_eq!(read(&link).expect("a file"), b"precious");
        let options = || OpenOptions::new().write(true).create(true).truncate(false).clone();
        let error = open_to_write(&link, &options()).expect_err("a link");
        assert_eq!(error.kind(), ErrorKind::InvalidInput);
        assert!(error.to_string().contains("remove the link"), "{error}");
        open_to_write(&own, &options()).expect("a file of our own");
        open_to_write(&new, &options()).expect("a new file");
        // A link without a target would create the target.
        let dangling = folder.path().join("dangling");
        symlink(folder.path().join("nothing"), &dangling).expect("a link");
        assert!(open_to_write(&dangling, &options()).is_err());
        assert!(!folder.path().join("nothing").exists());
    }

    #[test]
    fn pipes_and_devices_are_refused_without_waiting() {
        let folder = tempfile::tempdir().expect("a folder");
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.expect("mkfifo").success());
        for path in [&*pipe, Path::new("/dev/zero")] {
            let error = open(path).expect_err("no plain file");
            assert_eq!(error.kind(), ErrorKind::InvalidInput, "{}", path.display());
            assert!(open_to_write(path, OpenOptions::new().append(true)).is_err());
        }
        assert_eq!(
            open(&folder.path().join("none")).expect_err("none").kind(),
            ErrorKind::NotFound
        );
    }
}
