//! Data sets in memory, and what is common to all that decides their bits.

use std::path::Path;

use pushplan::internals::watch::{Count, Watch};
use pushplan_bench::store::{RunManifest, StoreError, digest};
use rayon::prelude::*;

use super::config::DatasetConfig;
use super::error::DatasetError;
use super::lever::LeverConfig;

/// Everything that decides the bits of a data set. Episode `index` is a pure function of it and the
/// index.
pub trait Sampler: Clone + Sync {
    /// What is sampled, and what an engine says of it.
    type Episode: Clone + Send + Sync;

    /// So many episodes are drawn, on all threads, and then kept: a crash loses at most these, about
    /// ten seconds of work.
    const AT_ONCE: usize;

    /// Number of episodes.
    fn count(&self) -> u64;

    /// Whether it asks for anything, and for nothing impossible.
    ///
    /// # Errors
    /// [`DatasetError::Empty`] for zero episodes; [`DatasetError::Constraint`] for constraints that
    /// cannot be fulfilled.
    fn check(&self) -> Result<(), DatasetError>;

    /// The same as what a folder of episodes holds.
    fn manifest(&self) -> RunManifest;

    /// What the folder `dir` holds according to its manifest.
    ///
    /// # Errors
    /// [`DatasetError::Foreign`] if that is something else, or of another version; those of
    /// [`Self::check`].
    fn of(manifest: &RunManifest, dir: &Path) -> Result<Self, DatasetError>;

    /// Draws and simulates an episode.
    ///
    /// # Errors
    /// [`DatasetError::Player`] if another engine is asked, and ends.
    fn draw(&self, index: u64) -> Result<Self::Episode, DatasetError>;

    /// An episode as a record: every bit of its numbers, its index first.
    ///
    /// # Errors
    /// [`StoreError::Record`] if it has no form.
    fn encode(episode: &Self::Episode) -> Result<Vec<u8>, StoreError>;

    /// The episode that a record holds.
    ///
    /// # Errors
    /// Why it holds none.
    fn decode(record: &[u8]) -> Result<Self::Episode, String>;
}

/// All episodes of a data set, in order of their index.
#[derive(Clone, Debug, PartialEq)]
pub struct Set<S: Sampler> {
    config: S,
    episodes: Vec<S::Episode>,
}

/// Pushes.
pub type Dataset = Set<DatasetConfig>;

/// Lever-ups.
pub type LeverDataset = Set<LeverConfig>;

impl<S: Sampler> Set<S> {
    /// Draws and simulates every episode, on all threads of the current rayon pool; the same
    /// bits for any number of them.
    ///
    /// # Errors
    /// If the configuration asks for nothing, or `watch` says to stop.
    pub fn in_memory(config: &S, watch: &dyn Watch) -> Result<Self, DatasetError> {
        config.check()?;
        let count = Count::new(watch, 0, config.count() as usize);
        let indices: Vec<u64> = (0..config.count()).collect();
        let drawn = draw(config, &indices, &count, watch);
        let episodes = drawn.into_iter().collect::<Result<_, _>>()?;
        Ok(Self { config: config.clone(), episodes })
    }

    pub(super) fn from_parts(config: S, episodes: Vec<S::Episode>) -> Self {
        Self { config, episodes }
    }

    /// What the data set is made of.
    pub fn config(&self) -> &S {
        &self.config
    }

    /// Checksum over all episodes as records, hexadecimal.
    pub fn digest(&self) -> String {
        let records = self.episodes.iter().filter_map(|episode| S::encode(episode).ok());
        digest(&records.map(|record| digest(&record)).collect::<String>().into_bytes())
    }

    /// All episodes, in order of their index.
    pub fn episodes(&self) -> &[S::Episode] {
        &self.episodes
    }
}

/// Draws the episodes with these indices in parallel, counting them; [`DatasetError::Cancelled`]
/// for those that were left when `watch` said to stop.
pub(super) fn draw<S: Sampler>(
    config: &S,
    indices: &[u64],
    count: &Count,
    watch: &dyn Watch,
) -> Vec<Result<S::Episode, DatasetError>> {
    let draw = |&index: &u64| {
        if watch.cancelled() {
            return Err(DatasetError::Cancelled);
        }
        let episode = config.draw(index)?;
        count.one();
        Ok(episode)
    };
    indices.par_iter().map(draw).collect()
}
