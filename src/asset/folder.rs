//! Listing of the files in a folder that are read together.

use std::path::{Path, PathBuf};

use super::diagnostic::Fault;

/// Returns the files of `folder` with one of the given extensions, sorted.
pub(super) fn files_in(folder: &Path, endings: &[&str]) -> Result<Vec<PathBuf>, Fault> {
    let wanted = |path: &PathBuf| {
        let end = path.extension().unwrap_or_default();
        path.is_file() && endings.iter().any(|ending| end == *ending)
    };
    Ok(entries(folder)?.into_iter().filter(wanted).collect())
}

/// Returns the recordings and trajectories (`.json`, `.yaml` and `.yml` files) of `folder` and its
/// subfolders, grouped by folder and sorted. Symbolic links to folders are not followed.
///
/// # Errors
/// Returns an error if a folder cannot be read, or no such file is found.
pub fn recordings_in(folder: &Path) -> Result<Vec<(PathBuf, Vec<PathBuf>)>, Fault> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let files = files_in(&folder, &["json", "yaml", "yml"])?;
        let inner =
            entries(&folder)?.into_iter().filter(|path| path.is_dir() && !path.is_symlink());
        folders.extend(inner.rev());
        if !files.is_empty() {
            found.push((folder, files));
        }
    }
    if found.is_empty() {
        let message = "the folder holds no recordings (*.json, *.yaml)";
        let advice = "`pushplan check --schema recording` prints the format of such files";
        return Err(Fault::of_file(&folder.display().to_string(), message, advice));
    }
    Ok(found)
}

/// Returns the entries of a folder, sorted.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let listing = |error: std::io::Error| Fault::io(folder, "read the folder", &error);
    let entries = std::fs::read_dir(folder).map_err(listing)?;
    let mut paths: Vec<PathBuf> =
        entries.map(|entry| Ok(entry.map_err(listing)?.path())).collect::<Result<_, Fault>>()?;
    paths.sort();
    Ok(paths)
}
