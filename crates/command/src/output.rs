//! Folder of the results.

use std::path::{Path, PathBuf};

use clap::Args;

use pushplan::asset::{Fault, write_atomic};
use pushplan_report::{Figure, PageView};

use super::action::LibraryArgs;
use super::error::CliError;
use super::value_enums::{VIEWS, possible_values};

/// Default folder of the results.
pub const FOLDER: &str = "plans";

/// Where results go, what their page shows, and which tools there are.
#[derive(Args, Debug)]
pub struct ResultArgs {
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = FOLDER)]
    pub out: PathBuf,
    /// What the page shows
    #[arg(long, value_parser = possible_values(&VIEWS), value_name = "VIEW", default_value = "2d")]
    pub page: PageView,
    #[command(flatten)]
    pub library: LibraryArgs,
}

/// Creates the folder and checks that it is writable, before any long computation.
///
/// # Errors
/// Returns [`CliError::Output`] if the folder cannot be created or written.
pub fn prepare(folder: &Path) -> Result<(), CliError> {
    let refused = |error: std::io::Error| {
        CliError::Output(Fault::io(folder, "write to the folder", &error).into())
    };
    std::fs::create_dir_all(folder).map_err(refused)?;
    tempfile::tempfile_in(folder).map(drop).map_err(refused)
}

/// Writes a file into the folder atomically and returns its path.
///
/// # Errors
/// Returns [`CliError::Output`] on failure.
pub fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<PathBuf, CliError> {
    let path = folder.join(name);
    write_atomic(&path, bytes).map_err(CliError::Output)?;
    Ok(path)
}

/// Writes figures into the folder and returns their paths.
///
/// # Errors
/// Returns [`CliError::Output`] if one cannot be written.
pub fn write_figures<'a>(
    folder: &Path,
    figures: impl IntoIterator<Item = &'a Figure>,
) -> Result<Vec<PathBuf>, CliError> {
    let figures = figures.into_iter();
    figures.map(|figure| write(folder, &figure.file_name(), figure.to_svg().as_bytes())).collect()
}
