//! What a simulated world is really like.

use serde::{Deserialize, Serialize};

use super::Noise;
use crate::scene::{Engine, Scene};

/// What a simulated world is really like, and how it is seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truth {
    /// What stands where, with joints, masses, frictions and supports as they are.
    pub scene: Scene,
    /// What moves it.
    pub engine: Engine,
    /// Errors of what is seen.
    pub noise: Noise,
    /// Whether headings are seen.
    pub headings: bool,
    /// Seed of these errors.
    pub seed: u64,
}

impl Truth {
    /// The default errors, those of a good camera: 1 mm and half a degree.
    pub const NOISE: Noise = Noise { position: 1e-3, heading: 0.5 * std::f64::consts::PI / 180.0 };

    /// A world that is as `scene` states it, in the planar engine, seen with [`Self::NOISE`].
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
