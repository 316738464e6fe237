//! Configuration of a data set, which determines its bits.

use std::path::Path;
use std::sync::Arc;

use pushplan::internals::{
    outcome::Frame,
    scene::{Ranges, Scene, Tool},
    task::{Stroke, ToolMotion},
};
use pushplan_bench::store::{RunManifest, StoreError};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::constraints::Constraints;
use super::episode::Episode;
use super::error::DatasetError;
use super::mujoco;
use super::preset::Preset;
use super::set::Sampler;
use super::truth::Truth;

/// Suite name of a folder of episodes.
pub const SUITE: &str = "episodes";

/// Suite name of a folder of `.npz` files.
const SUITE_OF_FILES: &str = "episodes as npz";

/// Version of the sampler; other versions draw other episodes for equal settings.
const SAMPLER: u32 = 8;

/// Episode as a record: index, scene, tool, lift, strokes, frames. `postcard` preserves every bit
/// of a number.
type Fields = (u64, Scene, Tool, f64, Vec<Stroke>, Vec<Frame>);

/// Settings in a manifest.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sampled {
    sampler: u32,
    preset: Preset,
    constraints: Constraints,
    #[serde(default)]
    truth: Truth,
}

/// Configuration that determines the bits of a data set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DatasetConfig {
    /// Seed; episode `index` depends only on it, the preset, the constraints and `index`.
    pub seed: u64,
    /// Number of episodes.
    pub episodes: u64,
    /// Family of sampled scenes.
    pub preset: Preset,
    /// Properties that are fixed instead of sampled.
    #[serde(default)]
    pub constraints: Constraints,
    /// Source of the ground truth for pushes with tools.
    #[serde(default)]
    pub truth: Truth,
}

impl Default for DatasetConfig {
    fn default() -> Self {
        Self {
            seed: 1,
            episodes: 60_000,
            preset: Preset::Tools,
            constraints: Constraints::default(),
            truth: Truth::default(),
        }
    }
}

impl DatasetConfig {
    /// Returns the ranges covered by the data.
    pub fn ranges(&self) -> Ranges {
        self.constraints.narrow(self.preset.ranges())
    }

    /// Returns the configuration with another seed and size, for example for a validation split.
    pub fn split(&self, seed: u64, episodes: u64) -> Self {
        Self { seed, episodes, ..self.clone() }
    }

    /// Returns the manifest of a folder of files with this number of episodes each.
    pub(super) fn manifest_of_files(&self, files: usize, episodes_a_file: u64) -> RunManifest {
        let mut settings = json!(self.sampled());
        settings["episodes"] = json!(self.episodes);
        settings["episodes_a_file"] = json!(episodes_a_file);
        RunManifest::new(SUITE_OF_FILES, files, self.seed, &self.played_by())
            .with_settings(settings)
    }

    fn sampled(&self) -> Sampled {
        let &Self { preset, constraints, truth, .. } = self;
        Sampled { sampler: SAMPLER, preset, constraints, truth }
    }

    /// Returns the names of the engines, with the version of external ones.
    pub fn played_by(&self) -> String {
        match self.truth {
            Truth::Both => "planar and 3d".to_owned(),
            Truth::Planar => "planar".to_owned(),
            Truth::Spatial => "3d".to_owned(),
            Truth::Mujoco => format!("mujoco {}", mujoco::version().unwrap_or("?")),
        }
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
            _ if self.truth != Truth::Both && self.preset.is_crowd() => {
                let why = "crowds are always simulated by the 2-D engine; omit --truth";
                Err(DatasetError::Constraint(why.to_owned()))
            }
            _ => self.constraints.check(self.preset),
        }
    }

    fn manifest(&self) -> RunManifest {
        RunManifest::new(SUITE, self.episodes as usize, self.seed, &self.played_by())
            .with_settings(json!(self.sampled()))
    }

    fn of(manifest: &RunManifest, dir: &Path) -> Result<Self, DatasetError> {
        let other = || DatasetError::Foreign { path: dir.to_owned() };
        let settings: Option<Sampled> = serde_json::from_value(manifest.settings.clone()).ok();
        let sampled =
            settings.filter(|settings| manifest.suite == SUITE && settings.sampler == SAMPLER);
        let Sampled { preset, constraints, truth, .. } = sampled.ok_or_else(other)?;
        let (seed, episodes) = (manifest.seed, manifest.tasks as u64);
        let config = Self { seed, episodes, preset, constraints, truth };
        config.check()?;
        Ok(config)
    }

    fn draw(&self, index: u64) -> Result<Episode, DatasetError> {
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
