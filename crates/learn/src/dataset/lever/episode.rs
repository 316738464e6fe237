//! Episode: a random scene, a random lever-up and its effect.

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

/// Number of consecutive episodes with the same shape.
pub const LEVERS_PER_SHAPE: u64 = 4;

/// Constant that separates the seeds of shapes and actions.
const SHAPES: u64 = 0x5348_4150;

/// Lever-up with its ground truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverEpisode {
    /// Index of the episode in its data set.
    pub index: u64,
    /// Scene at the start.
    pub scene: LeverScene,
    /// Motion of the blade.
    pub lever: LeverUp,
    /// Effect of the lever-up.
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

    /// Returns the index of the shape in its data set.
    pub fn shape(&self) -> u64 {
        self.index / LEVERS_PER_SHAPE
    }

    /// Returns scene and lever-up.
    pub fn job(&self) -> LeverJob {
        LeverJob { scene: Arc::new(self.scene.clone()), lever: self.lever }
    }

    /// Simulates the episode again and returns the states after every step of the engine.
    pub fn motion(&self) -> Vec<(Frame, f64)> {
        LeverSimulator::FINE.record(&self.job(), 0.0).1
    }

    /// Returns the episode with its trajectory ended where the plate slips off the blade; `None` if
    /// it slips at once.
    pub fn before_slip(&self) -> Option<Self> {
        let mut cut = self.clone();
        let frames = cut.trajectory.before_slip();
        cut.trajectory.lift.truncate(frames);
        cut.trajectory.held.truncate(frames);
        (frames > 0).then_some(cut)
    }

    /// Returns `true` if the simulation came to rest without a jam.
    pub fn is_sound(&self) -> bool {
        let unsound = [LeverWarning::Jammed, LeverWarning::Moving];
        !self.trajectory.warnings.iter().any(|warning| unsound.contains(warning))
    }
}

/// Returns scene and lever-up of episode `index` without simulation. The result depends only on the
/// arguments.
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
