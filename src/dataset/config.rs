//! What a data set is made of: everything that decides its bits.

use serde::{Deserialize, Serialize};

use crate::scene::Ranges;

use super::{constraints::Constraints, error::DatasetError, preset::Preset};

/// Everything that decides the bits of a data set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DatasetConfig {
    /// Episode `index` depends on this, the preset, the constraints and `index` alone.
    pub seed: u64,
    /// Number of episodes.
    pub episodes: u64,
    /// Episodes in one file: an interrupted generation loses at most one file's worth, about a
    /// second of work (of tools; up to half a minute of sparse scenes) at the default of 512.
    pub episodes_per_shard: u64,
    /// What is sampled.
    pub preset: Preset,
    /// What is fixed rather than sampled.
    #[serde(default)]
    pub constraints: Constraints,
}

impl Default for DatasetConfig {
    fn default() -> Self {
        Self {
            seed: 1,
            episodes: 60_000,
            episodes_per_shard: 512,
            preset: Preset::Tools,
            constraints: Constraints::default(),
        }
    }
}

impl DatasetConfig {
    /// What the data cover.
    pub fn ranges(&self) -> Ranges {
        self.constraints.narrow(self.preset.ranges())
    }

    /// The same data for another seed and size: a validation split.
    pub fn split(&self, seed: u64, episodes: u64) -> Self {
        Self { seed, episodes, ..self.clone() }
    }

    /// Whether it asks for anything, and for nothing impossible.
    ///
    /// # Errors
    /// [`DatasetError::Empty`] for zero episodes, in all or in a file;
    /// [`DatasetError::Constraint`] for constraints that the preset cannot fulfil.
    pub fn check(&self) -> Result<(), DatasetError> {
        match (self.episodes, self.episodes_per_shard) {
            (0, _) => Err(DatasetError::Empty("episodes")),
            (_, 0) => Err(DatasetError::Empty("episodes_per_shard")),
            _ => self.constraints.check(self.preset),
        }
    }

    /// Number of shard files.
    pub fn shards(&self) -> u64 {
        self.episodes.div_ceil(self.episodes_per_shard.max(1))
    }
}
