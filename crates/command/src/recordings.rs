//! Recordings named on the command line: files, and folders of them.

use std::path::{Path, PathBuf};

use pushplan::asset::{self, Fault, Faults, Kind, TrajectoryFile};
use pushplan::recording::Recording;

use super::error::CliError;

/// Set of recordings that are evaluated together.
#[derive(Debug)]
pub struct RecordingSet {
    /// Name of the folder, or of the only recording.
    pub title: String,
    /// Recordings, at least one.
    pub recordings: Vec<Recording>,
}

/// Reads recordings. Each given file is a set, and so is each given folder and each of its
/// subfolders.
///
/// # Errors
/// Returns all faults of all files, and an error for a folder without recordings.
pub fn load_recordings(paths: &[PathBuf]) -> Result<Vec<RecordingSet>, CliError> {
    let (mut sets, mut faults) = (Vec::new(), Vec::new());
    for path in paths {
        if !path.is_dir() {
            match load(path) {
                Ok(recording) => sets.push(RecordingSet {
                    title: recording.name.clone(),
                    recordings: vec![recording],
                }),
                Err(found) => faults.extend(found.0),
            }
            continue;
        }
        for (folder, files) in asset::recordings_in(path).map_err(Faults::from)? {
            let mut recordings = Vec::new();
            for file in files {
                match load(&file) {
                    Ok(recording) => recordings.push(recording),
                    Err(found) => faults.extend(found.0),
                }
            }
            sets.push(RecordingSet { title: folder.display().to_string(), recordings });
        }
    }
    if faults.is_empty() { Ok(sets) } else { Err(Faults(faults).into()) }
}

/// Reads a recording, or a trajectory file as a recording; refuses other files.
fn load(file: &Path) -> Result<Recording, Faults> {
    match asset::check(file, None)? {
        Kind::Trajectory => {
            let file = TrajectoryFile::load(file)?;
            let flat = file.trajectory.frames.iter().all(|frame| frame.state.space.is_none());
            let slides = file.plan.slides(&file.tools).filter(|_| flat);
            let Some([motion]) = slides.as_deref() else {
                let message =
                    "a trajectory that leaves the plane or changes the tool is no push recording";
                return Err(Fault::of_file(&file.task.name, message, "omit this file").into());
            };
            let frames = &file.trajectory.frames;
            Ok(Recording::of_frames(&file.task.name, &file.task.scene, motion, frames))
        }
        Kind::Recording => Recording::load(file),
        other => {
            let message = format!("this is a {other} file, not a recording");
            let advice = "name recordings, trajectories or folders of them";
            Err(Fault::of_file(&file.display().to_string(), message, advice).into())
        }
    }
}
