//! Mesh files that a URDF names: in or below its own folder, or a folder that the user allows.

use std::path::{Path, PathBuf};
use std::sync::{PoisonError, RwLock};

use pushplan_import::foreign::{Files, Refused};

/// Allowed folders of this process, global because files are read in many places. A task cannot add
/// one, because tasks may come from other users.
static ALLOWED: RwLock<Vec<PathBuf>> = RwLock::new(Vec::new());

/// Allows the URDFs of arms to name meshes in and below `folder`, in addition to their own folders.
pub fn allow_files_in(folder: impl Into<PathBuf>) {
    ALLOWED.write().unwrap_or_else(PoisonError::into_inner).push(folder.into());
}

/// Finds the mesh `name` of the URDF at `path`.
pub(super) fn find(path: &Path, name: &str) -> Result<PathBuf, Refused> {
    let own = Files::of(path, None).find("", name);
    let allowed = ALLOWED.read().unwrap_or_else(PoisonError::into_inner);
    let elsewhere = |_| {
        let mut found = allowed.iter().map(|root| Files::of(path, Some(root)).find("", name));
        found.find_map(Result::ok).ok_or(())
    };
    own.clone().or_else(elsewhere).or(own)
}
