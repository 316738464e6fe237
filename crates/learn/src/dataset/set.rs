//! Data sets in memory and the interface of their configurations.

use std::path::Path;

use pushplan::internals::progress::{Count, Progress};
use pushplan_bench::store::{RunManifest, StoreError, digest};
use rayon::prelude::*;

use super::config::DatasetConfig;
use super::error::DatasetError;
use super::lever::LeverConfig;

/// Configuration that determines the bits of a data set. Episode `index` depends only on the
/// configuration and the index.
pub trait Sampler: Clone + Sync {
    /// Sampled episode with its simulated effect.
    type Episode: Clone + Send + Sync;

    /// Number of episodes drawn in parallel before they are stored. A crash loses at most these,
    /// about ten seconds of work.
    const AT_ONCE: usize;

    /// Returns the number of episodes.
    fn count(&self) -> u64;

    /// Checks that the configuration requests data and can be satisfied.
    ///
    /// # Errors
    /// Returns [`DatasetError::Empty`] for zero episodes; [`DatasetError::Constraint`] for
    /// constraints that cannot be satisfied.
    fn check(&self) -> Result<(), DatasetError>;

    /// Returns the manifest of a folder of episodes.
    fn manifest(&self) -> RunManifest;

    /// Reads the configuration of the folder `dir` from its manifest.
    ///
    /// # Errors
    /// Returns [`DatasetError::Foreign`] for other contents or another version, and the errors of
    /// [`Self::check`].
    fn of(manifest: &RunManifest, dir: &Path) -> Result<Self, DatasetError>;

    /// Draws and simulates an episode.
    ///
    /// # Errors
    /// Returns [`DatasetError::Player`] if an external engine is required and fails.
    fn draw(&self, index: u64) -> Result<Self::Episode, DatasetError>;

    /// Encodes an episode as a record that starts with its index and preserves all bits.
    ///
    /// # Errors
    /// Returns [`StoreError::Record`] if the episode cannot be encoded.
    fn encode(episode: &Self::Episode) -> Result<Vec<u8>, StoreError>;

    /// Decodes the episode of a record.
    ///
    /// # Errors
    /// Returns the reason if the record holds no episode.
    fn decode(record: &[u8]) -> Result<Self::Episode, String>;
}

/// Episodes of a data set, in order of their index.
#[derive(Clone, Debug, PartialEq)]
pub struct Set<S: Sampler> {
    config: S,
    episodes: Vec<S::Episode>,
}

/// Data set of pushes.
pub type Dataset = Set<DatasetConfig>;

/// Data set of lever-ups.
pub type LeverDataset = Set<LeverConfig>;

impl<S: Sampler> Set<S> {
    /// Draws and simulates every episode on all threads of the current rayon pool. The result is
    /// bit-identical for any number of threads.
    ///
    /// # Errors
    /// Returns an error if the configuration requests no data, or `progress` cancels.
    pub fn in_memory(config: &S, progress: &dyn Progress) -> Result<Self, DatasetError> {
        config.check()?;
        let count = Count::new(progress, 0, config.count() as usize);
        let indices: Vec<u64> = (0..config.count()).collect();
        let drawn = draw(config, &indices, &count, progress);
        let episodes = drawn.into_iter().collect::<Result<_, _>>()?;
        Ok(Self { config: config.clone(), episodes })
    }

    pub(super) fn from_parts(config: S, episodes: Vec<S::Episode>) -> Self {
        Self { config, episodes }
    }

    /// Returns the configuration.
    pub fn config(&self) -> &S {
        &self.config
    }

    /// Returns the hexadecimal checksum over all episodes as records.
    pub fn digest(&self) -> String {
        let records = self.episodes.iter().filter_map(|episode| S::encode(episode).ok());
        digest(&records.map(|record| digest(&record)).collect::<String>().into_bytes())
    }

    /// Returns all episodes, in order of their index.
    pub fn episodes(&self) -> &[S::Episode] {
        &self.episodes
    }
}

/// Draws the episodes with these indices in parallel and counts them; [`DatasetError::Cancelled`]
/// for episodes left after a cancellation.
pub(super) fn draw<S: Sampler>(
    config: &S,
    indices: &[u64],
    count: &Count,
    progress: &dyn Progress,
) -> Vec<Result<S::Episode, DatasetError>> {
    let draw = |&index: &u64| {
        if progress.cancelled() {
            return Err(DatasetError::Cancelled);
        }
        let episode = config.draw(index)?;
        count.one();
        Ok(episode)
    };
    indices.par_iter().map(draw).collect()
}
