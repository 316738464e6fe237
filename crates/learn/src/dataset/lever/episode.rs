//! One episode: a random scene, a random lever-up and what it does.

use std::sync::Arc;

use pushplan::internals::seeded::generator;
use pushplan::internals::sim::LeverSimulator;
use pushplan::internals::{
    outcome::{Frame, LeverTrajectory, LeverWarning},
    scene::LeverScene,
    task::{LeverJob, LeverUp},
};
use serde::{Deserialize, Serialize};

use super::config::LeverConfig;
use super::preset::{DISC_PLACES, LeverPreset};
use super::{drive, lying, plates};

/// So many neighbouring episodes lever the same shape.
pub const LEVERS_PER_SHAPE: u64 = 4;

/// Shapes are drawn under another seed than actions.
const SHAPES: u64 = 0x5348_4150;

/// A lever-up and the truth of what it does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverEpisode {
    /// Which draw of its data set this is.
    pub index: u64,
    /// What stands on the table.
    pub scene: LeverScene,
    /// What the blade does.
    pub lever: LeverUp,
    /// What comes of it.
    pub trajectory: LeverTrajectory,
}

impl LeverEpisode {
    /// Draws and simulates episode `index`.
    pub fn draw(config: &LeverConfig, index: u64) -> Self {
        let LeverJob { scene, lever } = lever_job(config, index);
        let job = LeverJob { scene, lever };
        let trajectory = LeverSimulator::FINE.run(&job);
        Self { index, scene: LeverScene::clone(&job.scene), lever, trajectory }
    }

    /// Which shape of its data set this is.
    pub fn shape(&self) -> u64 {
        self.index / LEVERS_PER_SHAPE
    }

    /// Scene and lever-up.
    pub fn job(&self) -> LeverJob {
        LeverJob { scene: Arc::new(self.scene.clone()), lever: self.lever }
    }

    /// Everything that moves, after every step of the engine: simulated again.
    pub fn motion(&self) -> Vec<(Frame, f64)> {
        LeverSimulator::FINE.record(&self.job(), 0.0).1
    }

    /// The same with a trajectory that ends where the plate slips off the blade; none if it does at
    /// once.
    pub fn before_slip(&self) -> Option<Self> {
        let mut cut = self.clone();
        let frames = cut.trajectory.before_slip();
        cut.trajectory.lift.truncate(frames);
        cut.trajectory.held.truncate(frames);
        (frames > 0).then_some(cut)
    }

    /// Whether the engine came to rest and nothing was jammed.
    pub fn is_sound(&self) -> bool {
        let unsound = [LeverWarning::Jammed, LeverWarning::Moving];
        !self.trajectory.warnings.iter().any(|warning| unsound.contains(warning))
    }
}

/// Scene and lever-up of episode `index`, without what happens: a pure function of both.
pub fn lever_job(config: &LeverConfig, index: u64) -> LeverJob {
    let shape = index / LEVERS_PER_SHAPE;
    let shapes = &mut generator(config.seed ^ SHAPES, shape);
    let rng = &mut generator(config.seed, index);
    let (scene, lever) = match config.preset {
        LeverPreset::Fixed => plates::fixed(shapes, rng, shape),
        LeverPreset::Varied => plates::varied(shapes, rng, shape),
        LeverPreset::Disc => plates::disc(rng, (index % DISC_PLACES as u64) as usize),
        LeverPreset::Board => plates::board(rng),
        LeverPreset::Drive => drive::drive(shapes, rng),
        LeverPreset::Lying => lying::lying(shapes, rng),
    };
    LeverJob { scene: Arc::new(scene), lever }
}
