//! Lever-ups in memory and on disk: runs whose records are episodes, see [`pushplan::internals::store`].

use std::path::Path;

use pushplan::internals::store::{Form, Journal, RunManifest, Shard, StoreError, read_records};
use pushplan::internals::watch::{Count, Watch};
use rayon::prelude::*;

use super::super::error::DatasetError;
use super::config::LeverConfig;
use super::episode::LeverEpisode;

/// So many episodes are drawn, on all threads, and then kept: a crash loses at most these, some
/// seconds of work.
const AT_ONCE: usize = 256;

/// All lever-ups of a set, in order of their index.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverDataset {
    config: LeverConfig,
    episodes: Vec<LeverEpisode>,
}

impl LeverDataset {
    /// Draws and simulates every episode, on all threads of the current rayon pool; the same bits
    /// for any number of them.
    ///
    /// # Errors
    /// If the configuration asks for nothing, or `watch` says to stop.
    pub fn in_memory(config: &LeverConfig, watch: &dyn Watch) -> Result<Self, DatasetError> {
        config.check()?;
        let count = Count::new(watch, 0, config.episodes as usize);
        let indices: Vec<u64> = (0..config.episodes).collect();
        let drawn = draw(config, &indices, &count, watch);
        let episodes = drawn.into_iter().collect::<Option<_>>().ok_or(DatasetError::Cancelled)?;
        Ok(Self { config: *config, episodes })
    }

    /// Reads a finished set from a folder.
    ///
    /// # Errors
    /// If there is none, it is unfinished, or a file is damaged.
    pub fn open(dir: &Path) -> Result<Self, DatasetError> {
        let manifest = RunManifest::expect(dir)?;
        let config = LeverConfig::of(&manifest, dir)?;
        if let Some(shard) = manifest.shard {
            return Err(DatasetError::Shard { path: dir.to_owned(), shard });
        }
        let mut episodes = Vec::new();
        let held = read_records(dir, &manifest, Form::Frames, &mut |record| {
            let episode = decode(record)?;
            let index = episode.index as usize;
            episodes.push(episode);
            Ok(index)
        })?;
        let (done, total) = (held.count, manifest.tasks);
        if done < total {
            return Err(StoreError::Unfinished { path: dir.to_owned(), done, total }.into());
        }
        Ok(Self { config, episodes })
    }

    /// What the set is made of.
    pub fn config(&self) -> &LeverConfig {
        &self.config
    }

    /// All episodes, in order of their index.
    pub fn episodes(&self) -> &[LeverEpisode] {
        &self.episodes
    }
}

/// Makes a set in the folder `dir`, or finishes one that was interrupted: what is there and whole is
/// kept. The files are the same bits for any number of threads and interruptions. Of a `shard` only its
/// episodes are made; [`merge_data`](crate::dataset::merge_data) puts shards together. Gives how many
/// episodes the folder holds, and their size in bytes.
///
/// # Errors
/// If the configuration asks for nothing, the folder holds something else or another process writes
/// to it, a file cannot be written, or `watch` says to stop. Finished episodes are kept in every case.
pub fn generate_levers(
    config: &LeverConfig,
    shard: Shard,
    dir: &Path,
    watch: &dyn Watch,
) -> Result<(usize, u64), DatasetError> {
    config.check()?;
    let manifest = config.manifest().with_shard(shard);
    let indices: Vec<u64> = manifest.indices().map(|index| index as u64).collect();
    let mut journal = Journal::open(dir, manifest, Form::Frames, watch, &mut |record| {
        Ok(decode(record)?.index as usize)
    })?;
    let count = Count::new(watch, journal.done(), indices.len());
    while journal.done() < indices.len() {
        let end = (journal.done() + AT_ONCE).min(indices.len());
        let drawn = draw(config, &indices[journal.done()..end], &count, watch);
        // Of what is stopped, the beginning without a hole can be kept.
        let whole = drawn.iter().map_while(Option::as_ref);
        let records: Vec<Vec<u8>> = whole.map(encode).collect::<Result<_, _>>()?;
        journal.append(records.iter().map(Vec::as_slice))?;
        if journal.done() < end {
            return Err(DatasetError::Cancelled);
        }
    }
    Ok((journal.done(), journal.bytes()))
}

/// Draws the episodes of these indices in parallel, counting them; `None` for those that were
/// left when `watch` said to stop.
fn draw(
    config: &LeverConfig,
    indices: &[u64],
    count: &Count,
    watch: &dyn Watch,
) -> Vec<Option<LeverEpisode>> {
    let draw = |&index: &u64| {
        if watch.cancelled() {
            return None;
        }
        let episode = LeverEpisode::draw(config, index);
        count.one();
        Some(episode)
    };
    indices.par_iter().map(draw).collect()
}

/// An episode, and the heights of its blocks: obstacles keep theirs only in files that people read.
fn encode(episode: &LeverEpisode) -> Result<Vec<u8>, StoreError> {
    let heights: Vec<f64> = episode.scene.blocks.iter().map(|block| block.z).collect();
    postcard::to_allocvec(&(episode, heights)).map_err(|error| StoreError::Record {
        index: episode.index as usize,
        why: error.to_string(),
    })
}

fn decode(record: &[u8]) -> Result<LeverEpisode, String> {
    let read = postcard::from_bytes(record).map_err(|error| error.to_string());
    let (mut episode, heights): (LeverEpisode, Vec<f64>) = read?;
    let blocks = episode.scene.blocks.iter_mut();
    blocks.zip(heights).for_each(|(block, height)| block.z = height);
    Ok(episode)
}
