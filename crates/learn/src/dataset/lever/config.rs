//! Configuration of a set of lever-ups, which determines its bits.

use std::path::Path;

use pushplan_bench::store::{RunManifest, StoreError};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::super::error::DatasetError;
use super::super::set::Sampler;
use super::episode::LeverEpisode;
use super::preset::LeverPreset;

/// Suite name of a folder of lever-ups.
pub const LEVER_SUITE: &str = "levers";

/// Source of the ground truth.
const TRUTH: &str = "3d";

/// Version of the sampler; other versions draw other episodes for equal settings.
const SAMPLER: u32 = 2;

/// Settings in a manifest.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sampled {
    sampler: u32,
    preset: LeverPreset,
}

/// Configuration that determines the bits of a set of lever-ups.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeverConfig {
    /// Seed of the data set.
    ///
    /// Episode `index` depends only on the seed, the preset and `index`. Its shape depends only on
    /// the seed, the preset and `index` divided by [`LEVERS_PER_SHAPE`](super::LEVERS_PER_SHAPE).
    pub seed: u64,
    /// Number of episodes.
    pub episodes: u64,
    /// Family of lever-ups.
    pub preset: LeverPreset,
}

impl LeverConfig {
    /// Returns the configuration with another seed, which shares no random shape, and another size.
    pub fn split(&self, seed: u64, episodes: u64) -> Self {
        Self { seed, episodes, ..*self }
    }
}

impl Sampler for LeverConfig {
    type Episode = LeverEpisode;
    const AT_ONCE: usize = 256;

    fn count(&self) -> u64 {
        self.episodes
    }

    fn check(&self) -> Result<(), DatasetError> {
        if self.episodes == 0 { Err(DatasetError::Empty("episodes")) } else { Ok(()) }
    }

    fn manifest(&self) -> RunManifest {
        let settings = Sampled { sampler: SAMPLER, preset: self.preset };
        RunManifest::new(LEVER_SUITE, self.episodes as usize, self.seed, TRUTH)
            .with_settings(json!(settings))
    }

    fn of(manifest: &RunManifest, dir: &Path) -> Result<Self, DatasetError> {
        let settings: Option<Sampled> = serde_json::from_value(manifest.settings.clone()).ok();
        let sampled = settings
            .filter(|settings| manifest.suite == LEVER_SUITE && settings.sampler == SAMPLER);
        let Some(Sampled { preset, .. }) = sampled else {
            return Err(DatasetError::Foreign { path: dir.to_owned() });
        };
        let config = Self { seed: manifest.seed, episodes: manifest.tasks as u64, preset };
        config.check()?;
        Ok(config)
    }

    fn draw(&self, index: u64) -> Result<LeverEpisode, DatasetError> {
        Ok(LeverEpisode::draw(self, index))
    }

    /// Encodes an episode and the heights of its blocks, because the binary form of obstacles omits
    /// their heights.
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
}
