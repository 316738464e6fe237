//! Atomic writing of files: a partial file never appears under the final name.

use std::io::Write;
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
    let fault = |error: std::io::Error| Faults::from(Fault::io(path, "write the file", &error));
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
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
