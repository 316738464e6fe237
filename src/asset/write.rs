//! Atomic writing of files: a partial file never appears under the final name.

use std::io::{Error, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use super::diagnostic::{Fault, Faults};

/// Writes `bytes` to `path` through a temporary file in the same folder, which is flushed to disk
/// and then renamed. The old content stays until the new content is complete.
///
/// # Errors
/// Returns one fault if, for example, the folder is missing or read-only or the disk is full. No
/// temporary file remains.
pub fn write_atomic(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), Faults> {
    let path = path.as_ref();
    let fault = |error: Error| Faults::from(Fault::io(path, "write the file", &plain(error)));
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        let message = format!("cannot write the file: there is no folder `{}`", folder.display());
        let advice = "create the folder, or check the path; it is relative to the current folder";
        return Err(Fault::of_file(&path.display().to_string(), message, advice).into());
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".pushplan-");
    // Temporary files are private by default; results get the permissions that the umask allows.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file: NamedTempFile = builder.tempfile_in(folder).map_err(fault)?;
    file.write_all(bytes).map_err(fault)?;
    file.as_file().sync_all().map_err(fault)?;
    file.persist(path).map_err(|error| fault(error.error))?;
    Ok(())
}

/// Removes the name of the temporary file from an error.
fn plain(error: Error) -> Error {
    match error.to_string().split_once(" at path ") {
        Some((cause, _)) => Error::new(error.kind(), cause),
        None => error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_folder_is_named_instead_of_the_temporary_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let missing = folder.path().join("missing");
        let Faults(faults) = write_atomic(missing.join("plan.json"), b"{}").expect_err("no folder");
        assert!(
            faults[0].message.ends_with(&format!("there is no folder `{}`", missing.display()))
        );
        assert!(faults[0].advice.starts_with("create the folder"));
    }

    #[cfg(unix)]
    #[test]
    fn errors_do_not_name_the_temporary_file() {
        // The kernel allows no new files there, even to its superuser.
        let Faults(faults) = write_atomic("/proc/plan.json", b"{}").expect_err("no plain folder");
        assert!(!faults[0].message.contains(".pushplan-"), "{}", faults[0].message);
    }
}
