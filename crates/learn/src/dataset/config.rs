//! What a data set is made of: everything that decides its bits.

use std::path::Path;
use std::sync::Arc;

use pushplan::internals::scene::{Frame, Ranges, Scene, Stroke, Tool, ToolMotion};
use pushplan::internals::store::{RunManifest, StoreError};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::constraints::Constraints;
use super::episode::Episode;
use super::error::DatasetError;
use super::preset::Preset;
use super::set::Sampler;

/// The suite of a folder of episodes.
pub const SUITE: &str = "episodes";

/// The suite of a folder of `.npz` files.
const SUITE_OF_FILES: &str = "episodes as npz";

/// What the episodes show: the 3-D engine in most of those with tools.
const TRUTH: &str = "planar and 3d";

/// Version of the sampler: another one draws other episodes for the same settings.
const SAMPLER: u32 = 7;

/// An episode as a record: index, scene, tool, lift, strokes, frames. `postcard` keeps every bit of
/// a number.
type Fields = (u64, Scene, Tool, f64, Vec<Stroke>, Vec<Frame>);

/// The settings in a manifest.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sampled {
    sampler: u32,
    preset: Preset,
    constraints: Constraints,
}

/// Everything that decides the bits of a data set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DatasetConfig {
    /// Episode `index` depends on this, the preset, the constraints and `index` alone.
    pub seed: u64,
    /// Number of episodes.
    pub episodes: u64,
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

    /// The same as what a folder of files with so many episodes each holds.
    pub(super) fn manifest_of_files(&self, files: usize, episodes_a_file: u64) -> RunManifest {
        let sampled =
            Sampled { sampler: SAMPLER, preset: self.preset, constraints: self.constraints };
        let mut settings = json!(sampled);
        settings["episodes"] = json!(self.episodes);
        settings["episodes_a_file"] = json!(episodes_a_file);
        RunManifest::new(SUITE_OF_FILES, files, self.seed, TRUTH).with_settings(settings)
    }
}

impl Sampler for DatasetConfig {
    type Episode = Episode;
    const AT_ONCE: usize = 64;

    fn count(&self) -> u64 {
        self.episodes
    }

    fn check(&self) -> Result<(), DatasetError> {
        match self.episodes {
            0 => Err(DatasetError::Empty("episodes")),
            _ => self.constraints.check(self.preset),
        }
    }

    fn manifest(&self) -> RunManifest {
        let settings =
            Sampled { sampler: SAMPLER, preset: self.preset, constraints: self.constraints };
        RunManifest::new(SUITE, self.episodes as usize, self.seed, TRUTH)
            .with_settings(json!(settings))
    }

    fn of(manifest: &RunManifest, dir: &Path) -> Result<Self, DatasetError> {
        let other = || DatasetError::Foreign { path: dir.to_owned() };
        let settings: Option<Sampled> = serde_json::from_value(manifest.settings.clone()).ok();
        let sampled =
            settings.filter(|settings| manifest.suite == SUITE && settings.sampler == SAMPLER);
        let Sampled { preset, constraints, .. } = sampled.ok_or_else(other)?;
        let config =
            Self { seed: manifest.seed, episodes: manifest.tasks as u64, preset, constraints };
        config.check()?;
        Ok(config)
    }

    fn draw(&self, index: u64) -> Episode {
        Episode::draw(self, index)
    }

    fn encode(episode: &Episode) -> Result<Vec<u8>, StoreError> {
        let Episode { index, scene, motion: ToolMotion { tool, lift, strokes }, frames } = episode;
        postcard::to_allocvec(&(index, scene, &**tool, lift, strokes, frames))
            .map_err(|error| StoreError::Record { index: *index as usize, why: error.to_string() })
    }

    fn decode(record: &[u8]) -> Result<Episode, String> {
        let (index, scene, tool, lift, strokes, frames): Fields =
            postcard::from_bytes(record).map_err(|error| error.to_string())?;
        let motion = ToolMotion { tool: Arc::new(tool), lift, strokes };
        Ok(Episode { index, scene, motion, frames })
    }
}
