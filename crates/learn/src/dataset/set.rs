//! A data set in memory.

use pushplan::internals::watch::{Count, Watch};
use rayon::prelude::*;

use super::config::DatasetConfig;
use super::episode::Episode;
use super::error::DatasetError;

/// All episodes of a data set, in order of their index.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    config: DatasetConfig,
    episodes: Vec<Episode>,
}

impl Dataset {
    /// Draws and simulates every episode, on all threads of the current rayon pool; the same
    /// bits for any number of them.
    ///
    /// # Errors
    /// If the configuration asks for nothing, or `watch` says to stop.
    pub fn in_memory(config: &DatasetConfig, watch: &dyn Watch) -> Result<Self, DatasetError> {
        config.check()?;
        let count = Count::new(watch, 0, config.episodes as usize);
        let indices: Vec<u64> = (0..config.episodes).collect();
        let drawn = draw(config, &indices, &count, watch);
        let episodes = drawn.into_iter().collect::<Option<_>>().ok_or(DatasetError::Cancelled)?;
        Ok(Self { config: config.clone(), episodes })
    }

    pub(super) fn from_parts(config: DatasetConfig, episodes: Vec<Episode>) -> Self {
        Self { config, episodes }
    }

    /// What the data set is made of.
    pub fn config(&self) -> &DatasetConfig {
        &self.config
    }

    /// All episodes, in order of their index.
    pub fn episodes(&self) -> &[Episode] {
        &self.episodes
    }
}

/// Draws the episodes with these indices in parallel, counting them; `None` for those that were
/// left when `watch` said to stop.
pub(super) fn draw(
    config: &DatasetConfig,
    indices: &[u64],
    count: &Count,
    watch: &dyn Watch,
) -> Vec<Option<Episode>> {
    indices
        .par_iter()
        .map(|index| {
            if watch.cancelled() {
                return None;
            }
            let episode = Episode::draw(config, *index);
            count.one();
            Some(episode)
        })
        .collect()
}
