//! How far the shards of a run are.

use std::path::PathBuf;

use super::error::StoreError;
use super::form::Form;
use super::journal::read_records;
use super::lock::writer_of;
use super::manifest::RunManifest;
use super::merge::{Family, line_index};
use super::numbers::Numbers;
use super::shard::Shard;

/// How far the shards of a run are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunStatus {
    /// How many shards there are.
    pub of: usize,
    /// Those that have a folder, in the order of the folders.
    pub shards: Vec<ShardStatus>,
}

/// How far a shard is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShardStatus {
    /// Which one.
    pub shard: Shard,
    /// Its folder.
    pub folder: PathBuf,
    /// Finished tasks.
    pub done: usize,
    /// Tasks that it should have.
    pub tasks: usize,
    /// Process and host that write to it, or that were killed while they did.
    pub writer: Option<String>,
}

impl ShardStatus {
    /// Whether nothing is left to do.
    pub fn is_complete(&self) -> bool {
        self.done == self.tasks
    }
}

impl RunStatus {
    /// Looks at the shards of one run. A folder that is not there, or in which nothing was begun,
    /// is that of a missing shard. Writes nothing and needs no lock, so that it may look on while
    /// others write.
    ///
    /// # Errors
    /// If no folder holds a run, one is damaged or of another run, or a shard is there twice.
    pub fn of(folders: &[PathBuf]) -> Result<Self, StoreError> {
        let (mut family, mut shards) = (Family::default(), Vec::new());
        for folder in folders {
            let Some(manifest) = RunManifest::load(folder)? else { continue };
            let shard = family.add(folder, &manifest)?;
            let form = Form::of(folder);
            let mut indices = manifest.indices();
            let held = read_records(folder, &manifest, form, &mut |record| match form {
                Form::Lines => line_index(record),
                // Their checksums were right; what is in them is known to whoever wrote them.
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

    /// Numbers of the shards that are not finished, ascending.
    pub fn missing(&self) -> Vec<usize> {
        let finished = |number| {
            self.shards.iter().any(|one| one.is_complete() && one.shard.number() == number)
        };
        (1..=self.of).filter(|number| !finished(*number)).collect()
    }

    /// The same as array jobs take them, such as `3,7-9`; empty if nothing is missing.
    pub fn array(&self) -> String {
        Numbers(&self.missing()).to_string()
    }
}
