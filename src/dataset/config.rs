//! What a data set is made of: everything that decides its bits.

use serde::{Deserialize, Serialize};

use crate::scene::{Ranges, Span};

use super::error::DatasetError;

/// The family of scenes to sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// One to three objects, sometimes obstacles, pushed by random tools of cuboids.
    #[default]
    Tools,
}

impl Preset {
    /// What the family covers.
    pub fn ranges(self) -> Ranges {
        match self {
            Preset::Tools => Ranges {
                objects: Span::new(1.0, 3.0),
                mass: Span::new(0.05, 3.0),
                // Beyond this, touching bodies sink into each other in the simulator.
                mass_ratio: 10.0,
                friction: Span::new(0.1, 1.0),
                radius: Span::new(0.02, 0.08),
                side: Span::new(0.03, 0.30),
                aspect: 6.0,
                parts: Span::new(1.0, 5.0),
                part_length: Span::new(0.02, 0.50),
                part_width: Span::new(0.015, 0.15),
                part_radius: Span::new(0.01, 0.06),
                speed: Span::new(0.03, 0.3),
                travel: Span::new(0.05, 0.30),
                pushes: Span::new(1.0, 3.0),
            },
        }
    }
}

/// Everything that decides the bits of a data set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DatasetConfig {
    /// Episode `index` depends on this and on `index` alone.
    pub seed: u64,
    /// Number of episodes.
    pub episodes: u64,
    /// Episodes in one file: an interrupted generation loses at most one file's worth, about a
    /// second of work at the default of 512.
    pub episodes_per_shard: u64,
    /// What is sampled.
    pub preset: Preset,
}

impl Default for DatasetConfig {
    fn default() -> Self {
        Self { seed: 1, episodes: 40_000, episodes_per_shard: 512, preset: Preset::Tools }
    }
}

impl DatasetConfig {
    /// What the data cover.
    pub fn ranges(&self) -> Ranges {
        self.preset.ranges()
    }

    /// The same data for another seed and size: a validation split.
    pub fn split(&self, seed: u64, episodes: u64) -> Self {
        Self { seed, episodes, ..self.clone() }
    }

    /// Whether it asks for anything at all.
    ///
    /// # Errors
    /// [`DatasetError::Empty`] for zero episodes, in all or in a file.
    pub fn check(&self) -> Result<(), DatasetError> {
        match (self.episodes, self.episodes_per_shard) {
            (0, _) => Err(DatasetError::Empty("episodes")),
            (_, 0) => Err(DatasetError::Empty("episodes_per_shard")),
            _ => Ok(()),
        }
    }

    /// Number of shard files.
    pub fn shards(&self) -> u64 {
        self.episodes.div_ceil(self.episodes_per_shard.max(1))
    }
}
