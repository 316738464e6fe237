//! Writing files so that a partial one never appears under the final name.

use std::io::Write;
use std::path::Path;

use tempfile::NamedTempFile;

use super::fault::{Fault, Faults};

/// Writes `bytes` to `path`: into a temporary file in the same folder, flushed to the disk and
/// then renamed, so that the old content stays until the new one is whole.
///
/// # Errors
/// One fault if the folder is missing or read-only, the disk is full, and so on; nothing is
/// left behind then.
pub fn write_atomic(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), Faults> {
    let path = path.as_ref();
    let fault = |error: std::io::Error| Faults::from(Fault::io(path, "write the file", &error));
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".pushplan-");
    // Temporary files are private by default; results are for everybody whom the umask allows.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file: NamedTempFile = builder.tempfile_in(folder).map_err(fault)?;
    file.write_all(bytes).map_err(fault)?;
    file.as_file().sync_all().map_err(fault)?;
    file.persist(path).map_err(|error| fault(error.error))?;
    Ok(())
}
