//! Progress of a run's shards.

use std::path::PathBuf;

use super::error::StoreError;
use super::form::Form;
use super::journal::read_records;
use super::lock::writer_of;
use super::manifest::RunManifest;
use super::merge::{Family, line_index};
use super::numbers::Numbers;
use super::shard::Shard;

/// Progress of a run's shards.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunStatus {
    /// Number of shards of the run.
    pub of: usize,
    /// Shards with a folder, in the order of the folders.
    pub shards: Vec<ShardStatus>,
}

/// Progress of a shard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShardStatus {
    /// Shard of the run.
    pub shard: Shard,
    /// Folder of the shard.
    pub folder: PathBuf,
    /// Number of finished tasks.
    pub done: usize,
    /// Number of tasks of the shard.
    pub tasks: usize,
    /// Process and host that write to the folder, or that were killed while they did.
    pub writer: Option<String>,
}

impl ShardStatus {
    /// Returns `true` if all tasks are finished.
    pub fn is_complete(&self) -> bool {
        self.done == self.tasks
    }
}

impl RunStatus {
    /// Reads the progress of the shards of one run. A missing or empty folder belongs to a missing
    /// shard. The function writes nothing and needs no lock, so it works while other processes
    /// write.
    ///
    /// # Errors
    /// Returns an error if no folder holds a run, if one is damaged or of another run, or if a
    /// shard is duplicated.
    pub fn of(folders: &[PathBuf]) -> Result<Self, StoreError> {
        let (mut family, mut shards) = (Family::default(), Vec::new());
        for folder in folders {
            let Some(manifest) = RunManifest::load(folder)? else { continue };
            let shard = family.add(folder, &manifest)?;
            let form = Form::of(folder);
            let mut indices = manifest.indices();
            let held = read_records(folder, &manifest, form, &mut |record| match form {
                Form::Lines => line_index(record),
                // The checksums are valid, and the content is known only to the writer.
                Form::Frames => Ok(indices.next().unwrap_or(manifest.tasks)),
            })?;
            shards.push(ShardStatus {
                shard,
                folder: folder.clone(),
                done: held.count,
                tasks: manifest.indices().len(),
                writer: writer_of(folder),
            });
        }
        match family.of() {
            Some(of) => Ok(Self { of, shards }),
            None => Err(StoreError::NoRun { paths: folders.to_vec() }),
        }
    }

    /// Returns the numbers of the unfinished shards, ascending.
    pub fn missing(&self) -> Vec<usize> {
        let finished = |number| {
            self.shards.iter().any(|one| one.is_complete() && one.shard.number() == number)
        };
        (1..=self.of).filter(|number| !finished(*number)).collect()
    }

    /// Returns the unfinished shards in the format of array jobs, such as `3,7-9`; empty if none is
    /// missing.
    pub fn array(&self) -> String {
        Numbers(&self.missing()).to_string()
    }
}
