//! Export of predicted poses for other programs.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use pushplan::asset::write_atomic;
use pushplan_report::{PoseRow, poses_document};

use super::error::CliError;

/// Export of predicted poses.
#[derive(Args, Clone, Debug)]
pub struct PosesArgs {
    /// File for the predicted poses of all objects over time, .csv or .json: name, by (the model),
    /// object, time in s, x and y in m, heading in rad
    #[arg(long, value_name = "FILE")]
    export: Option<PosesFile>,
}

/// Pose file, with its format from the extension.
#[derive(Clone, Debug)]
struct PosesFile {
    path: PathBuf,
    json: bool,
}

impl FromStr for PosesFile {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let path = PathBuf::from(text);
        let end = path.extension().map(|end| end.to_ascii_lowercase());
        match end.as_ref().and_then(|end| end.to_str()) {
            Some("csv") => Ok(Self { path, json: false }),
            Some("json") => Ok(Self { path, json: true }),
            _ => Err("expected a file name that ends in .csv or .json".into()),
        }
    }
}

impl PosesArgs {
    /// Returns `true` if an export is wanted.
    pub fn wanted(&self) -> bool {
        self.export.is_some()
    }

    /// Writes the poses.
    ///
    /// # Errors
    /// Returns [`CliError::Output`] if the file cannot be written.
    pub fn write(&self, rows: &[PoseRow]) -> Result<(), CliError> {
        let Some(PosesFile { path, json }) = &self.export else { return Ok(()) };
        let document = poses_document(rows);
        let text = if *json { document.to_json() } else { document.to_csv() };
        write_atomic(path, text.as_bytes()).map_err(CliError::Output)
    }
}
