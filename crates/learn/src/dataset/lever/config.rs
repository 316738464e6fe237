//! What a set of lever-ups is made of: everything that decides its bits.

use std::path::Path;

use pushplan::internals::store::RunManifest;
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::super::error::DatasetError;
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

    /// Whether it asks for anything.
    ///
    /// # Errors
    /// [`DatasetError::Empty`] for zero episodes.
    pub fn check(&self) -> Result<(), DatasetError> {
        if self.episodes == 0 { Err(DatasetError::Empty("episodes")) } else { Ok(()) }
    }

    /// The same as what a folder of lever-ups holds.
    pub(super) fn manifest(&self) -> RunManifest {
        let settings = Sampled { sampler: SAMPLER, preset: self.preset };
        RunManifest::new(LEVER_SUITE, self.episodes as usize, self.seed, TRUTH)
            .with_settings(json!(settings))
    }

    /// What the folder `dir` holds according to its manifest.
    pub(in crate::dataset) fn of(manifest: &RunManifest, dir: &Path) -> Result<Self, DatasetError> {
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
}
