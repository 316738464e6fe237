//! Episode: a random scene, a random tool motion and its effect.

use pushplan::internals::seeded::generator;
use pushplan::internals::{outcome::Frame, scene::Scene, task::ToolMotion};

use super::config::DatasetConfig;
use super::curriculum::Block;
use super::dense::dense;
use super::error::DatasetError;
use super::preset::Preset;
use super::sparse::{sparse, sparse_line};
use super::tools::pushed_by_tool;

/// Scene, tool motion and ground truth.
///
/// The ground truth is from the 2-D engine if the scene states the height at which the tool
/// presses. Otherwise it is from the 3-D engine or MuJoCo, depending on the configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Episode {
    /// Index of the episode in its data set.
    pub index: u64,
    /// Scene at the start.
    pub scene: Scene,
    /// Motion of the tool.
    pub motion: ToolMotion,
    /// Frames of the engine, starting with the initial one.
    pub frames: Vec<Frame>,
}

impl Episode {
    /// Draws and simulates episode `index`, which depends only on `index` and the configuration's
    /// seed, preset, constraints and truth.
    ///
    /// # Errors
    /// Returns [`DatasetError::Player`] if the ground truth is from MuJoCo and MuJoCo is
    /// unavailable.
    pub fn draw(config: &DatasetConfig, index: u64) -> Result<Self, DatasetError> {
        let mut rng = generator(config.seed, index);
        if config.preset.is_crowd() {
            return Ok(Self::of_crowd(config, index));
        }
        let ranges = config.constraints.narrow(config.preset.ranges());
        // Almost every attempt succeeds; an attempt fails if no push could be aimed or an object
        // did not come to rest.
        loop {
            let drawn = pushed_by_tool(&mut rng, &ranges, config.preset, config.truth)?;
            if let Some((scene, motion, frames)) = drawn {
                return Ok(Self { index, scene, motion, frames });
            }
        }
    }

    /// Draws an episode of a crowd, which needs no external engine. For the preset of tools it
    /// draws a dense crowd.
    pub fn of_crowd(config: &DatasetConfig, index: u64) -> Self {
        let mut rng = generator(config.seed, index);
        // The family is drawn before the first attempt, so that families with more failures are not
        // rarer.
        let family = config.preset.member(&mut rng);
        let ranges = config.constraints.narrow(family.ranges());
        let block = Block::of(config, index);
        loop {
            let drawn = match family {
                Preset::Sparse => sparse(&mut rng, &ranges, &block),
                Preset::SparseLine => sparse_line(&mut rng, &ranges, &block),
                _ => dense(&mut rng, &ranges, &block),
            };
            if let Some((scene, motion, frames)) = drawn {
                return Self { index, scene, motion, frames };
            }
        }
    }
}
