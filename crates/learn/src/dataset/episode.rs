//! One episode: a random scene, a random tool motion and what it does.

use pushplan::internals::scene::{Frame, Scene, ToolMotion};
use pushplan::internals::seeded::generator;

use super::config::DatasetConfig;
use super::curriculum::Block;
use super::dense::dense;
use super::preset::Preset;
use super::sparse::{sparse, sparse_line};
use super::tools::pushed_by_tool;

/// A scene, a tool motion, and the truth of what it does: where the scene states how high the tool
/// presses, that of the planar engine, else that of the 3-D engine.
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
    /// preset and constraints, and the index.
    pub fn draw(config: &DatasetConfig, index: u64) -> Self {
        let mut rng = generator(config.seed, index);
        // Before the first attempt, so that families that fail more often are no rarer.
        let family = config.preset.member(&mut rng);
        let ranges = config.constraints.narrow(family.ranges());
        let block = Block::of(config, index);
        // Almost every attempt succeeds; one fails when no push could be aimed or something
        // did not come to rest.
        loop {
            let drawn = match family {
                Preset::Sparse => sparse(&mut rng, &ranges, &block),
                Preset::SparseLine => sparse_line(&mut rng, &ranges, &block),
                Preset::Dense => dense(&mut rng, &ranges, &block),
                Preset::Tools | Preset::Mixed => pushed_by_tool(&mut rng, &ranges),
            };
            if let Some((scene, motion, frames)) = drawn {
                return Self { index, scene, motion, frames };
            }
        }
    }
}

/// Scene and motion of episode `index`, without what happens.
pub fn sample(config: &DatasetConfig, index: u64) -> (Scene, ToolMotion) {
    let episode = Episode::draw(config, index);
    (episode.scene, episode.motion)
}
