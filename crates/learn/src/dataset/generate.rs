//! Data sets on disk: runs with episodes as records, see [`pushplan_bench::store`].

use std::path::{Path, PathBuf};

use pushplan::internals::progress::{Count, Progress};
use pushplan_bench::store::{
    Form, Journal, RunManifest, Shard, StoreError, merge_runs, read_records,
};

use super::config::DatasetConfig;
use super::error::DatasetError;
use super::lever::{LEVER_SUITE, LeverConfig};
use super::set::{Sampler, Set, draw};

/// Makes a data set in the folder `dir`, or completes an interrupted one.
///
/// Intact files are kept. The files are bit-identical for any number of threads and interruptions.
/// Only the episodes of `shard` are made; [`merge_data`] merges shards. Returns the number of
/// episodes in the folder and their size in bytes.
///
/// # Errors
/// Returns an error if the configuration requests no data, the folder holds other settings or is
/// locked, a file cannot be written, or `progress` cancels. Finished episodes are always kept.
pub fn generate<S: Sampler>(
    config: &S,
    shard: Shard,
    dir: &Path,
    progress: &dyn Progress,
) -> Result<(usize, u64), DatasetError> {
    config.check()?;
    let manifest = config.manifest().with_shard(shard);
    let indices: Vec<u64> = manifest.indices().map(|index| index as u64).collect();
    let mut journal =
        Journal::open(dir, manifest, Form::Frames, progress, &mut |record| index(record))?;
    let count = Count::new(progress, journal.done(), indices.len());
    while journal.done() < indices.len() {
        let end = (journal.done() + S::AT_ONCE).min(indices.len());
        let drawn = draw(config, &indices[journal.done()..end], &count, progress);
        // After a cancellation, the gapless beginning can be kept.
        let whole = drawn.iter().map_while(|episode| episode.as_ref().ok());
        let records: Vec<Vec<u8>> = whole.map(S::encode).collect::<Result<_, _>>()?;
        journal.append(records.iter().map(Vec::as_slice))?;
        drawn.into_iter().collect::<Result<Vec<_>, _>>()?;
    }
    Ok((journal.done(), journal.bytes()))
}

/// Merges the finished shards of a data set, in any order, into the folder `out`.
///
/// The result is bit-identical to an unsharded run. Returns the number of episodes and their seed.
///
/// # Errors
/// Returns errors of [`merge_runs`], and an error for folders without episodes.
pub fn merge_data(out: &Path, shards: &[PathBuf]) -> Result<(usize, u64), DatasetError> {
    for dir in shards {
        let manifest = RunManifest::expect(dir)?;
        match manifest.suite.as_str() {
            LEVER_SUITE => LeverConfig::of(&manifest, dir).map(drop)?,
            _ => DatasetConfig::of(&manifest, dir).map(drop)?,
        }
    }
    let merged = merge_runs(out, shards, Form::Frames, &mut |record| index(record))?;
    Ok((merged.tasks, merged.seed))
}

impl<S: Sampler> Set<S> {
    /// Reads a finished data set from a folder.
    ///
    /// # Errors
    /// Returns an error if the folder holds no data set, the data set is unfinished, or a file is
    /// damaged.
    pub fn open(dir: &Path) -> Result<Self, DatasetError> {
        let manifest = RunManifest::expect(dir)?;
        let config = S::of(&manifest, dir)?;
        if let Some(shard) = manifest.shard {
            return Err(DatasetError::Shard { path: dir.to_owned(), shard });
        }
        let mut episodes = Vec::new();
        let held = read_records(dir, &manifest, Form::Frames, &mut |record| {
            episodes.push(S::decode(record)?);
            index(record)
        })?;
        let (done, total) = (held.count, manifest.tasks);
        if done < total {
            return Err(StoreError::Unfinished { path: dir.to_owned(), done, total }.into());
        }
        Ok(Self::from_parts(config, episodes))
    }
}

/// Returns the index of a record's episode, which is its first number.
fn index(record: &[u8]) -> Result<usize, String> {
    match postcard::take_from_bytes::<u64>(record) {
        Ok((index, _)) => Ok(index as usize),
        Err(error) => Err(error.to_string()),
    }
}
