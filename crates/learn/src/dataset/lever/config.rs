//! What a set of lever-ups is made of: everything that decides its bits.

use std::path::Path;

use pushplan_bench::store::{RunManifest, StoreError};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::super::error::DatasetError;
use super::super::set::Sampler;
use super::episode::LeverEpisode;
use super::preset::LeverPreset;

/// The suite of a folder of lever-ups.
pub const LEVER_SUITE: &str = "levers";

/// What the episodes show.
const TRUTH: &str = "3d";

/// Version of the sampler: another one draws other episodes for the same settings.
const SAMPLER: u32 = 2;

/// The settings in a manifest.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sampled {
    sampler: u32,
    preset: LeverPreset,
}

/// Everything that decides the bits of a set of lever-ups.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeverConfig {
    /// Episode `index` depends on this, the preset and `index` alone, its shape on this, the
    /// preset and `index` divided by [`LEVERS_PER_SHAPE`](super::LEVERS_PER_SHAPE).
    pub seed: u64,
    /// Number of episodes.
    pub episodes: u64,
    /// What is sampled.
    pub preset: LeverPreset,
}

impl LeverConfig {
    /// The same family under another seed, which shares no random shape, and of another size.
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

    /// An episode, and the heights of its blocks: obstacles keep theirs only in files that people
    /// read.
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
