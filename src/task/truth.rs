//! Ground truth of a simulated world.

use serde::{Deserialize, Serialize};

use super::Noise;
use crate::scene::{Engine, Scene};

/// The ground truth of a simulated world, and the errors of its observation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truth {
    /// True scene, with true joints, masses, frictions and supports.
    pub scene: Scene,
    /// Engine that moves it.
    pub engine: Engine,
    /// Observation errors.
    pub noise: Noise,
    /// Whether headings are observed.
    pub headings: bool,
    /// Seed of the observation errors.
    pub seed: u64,
}

impl Truth {
    /// Default observation errors of a good camera: 1 mm and half a degree.
    pub const NOISE: Noise = Noise { position: 1e-3, heading: 0.5 * std::f64::consts::PI / 180.0 };

    /// Creates a world as `scene` states it, in the 2-D engine, observed with [`Self::NOISE`].
    pub fn stated(scene: &Scene, seed: u64) -> Self {
        Self {
            scene: scene.clone(),
            engine: Engine::Planar,
            noise: Self::NOISE,
            headings: true,
            seed,
        }
    }
}
