//! One episode: a random scene, a random tool motion and what it does.

use pushplan::internals::seeded::generator;
use pushplan::internals::{outcome::Frame, scene::Scene, task::ToolMotion};

use super::config::DatasetConfig;
use super::curriculum::Block;
use super::dense::dense;
use super::error::DatasetError;
use super::preset::Preset;
use super::sparse::{sparse, sparse_line};
use super::tools::pushed_by_tool;

/// A scene, a tool motion, and the truth of what it does: where the scene states how high the tool
/// presses, that of the planar engine, else that of the 3-D engine or of MuJoCo, as the data set says.
#[derive(Clone, Debug, PartialEq)]
pub struct Episode {
    /// Which draw of its data set this is.
    pub index: u64,
    /// What stands on the table.
    pub scene: Scene,
    /// What the tool does.
    pub motion: ToolMotion,
    /// The engine's frames, the start first.
    pub frames: Vec<Frame>,
}

impl Episode {
    /// Draws and simulates episode `index`: a pure function of the configuration's seed, its
    /// preset, constraints and truth, and the index.
    ///
    /// # Errors
    /// [`DatasetError::Player`] if MuJoCo is to say what is true and cannot be asked.
    pub fn draw(config: &DatasetConfig, index: u64) -> Result<Self, DatasetError> {
        let mut rng = generator(config.seed, index);
        if config.preset.is_crowd() {
            return Ok(Self::of_crowd(config, index));
        }
        let ranges = config.constraints.narrow(config.preset.ranges());
        // Almost every attempt succeeds; one fails when no push could be aimed or something
        // did not come to rest.
        loop {
            if let Some((scene, motion, frames)) = pushed_by_tool(&mut rng, &ranges, config.truth)?
            {
                return Ok(Self { index, scene, motion, frames });
            }
        }
    }

    /// [`Episode::draw`] of crowds, which nobody else is asked about: of tools, a dense one.
    pub fn of_crowd(config: &DatasetConfig, index: u64) -> Self {
        let mut rng = generator(config.seed, index);
        // Before the first attempt, so that families that fail more often are no rarer.
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
