//! What trajectories are made of, and what an observer is told of it.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::{
    dataset::Episode,
    scene::{Engine, Frame, Job, Physics, Rate, Record, Scene},
    sim::Simulator,
};

/// Factors by which an observer is misled about friction values: of objects, of pairs and of the table.
const FRICTIONS: [f64; 2] = [0.6, 1.3];

/// What it takes every mass for, kg.
const MASS: f64 = 0.6;

/// What trajectories are made of, and what an observer is told of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Circumstances {
    /// The engine that they are simulated in.
    pub engine: Engine,
    /// Whether the observer is told wrong numbers: friction values of objects 0.6 times and of the
    /// table 1.3 times what they are, 0.6 kg for every mass.
    pub misled: bool,
}

impl Circumstances {
    /// The planar engine, and true numbers.
    pub const USUAL: Self = Self { engine: Engine::Planar, misled: false };

    /// An episode's frames in this engine. Episodes are drawn with the planar one, which has them.
    pub(super) fn frames(&self, episode: &Episode) -> Vec<Frame> {
        if self.engine == Engine::Planar {
            return episode.frames.clone();
        }
        let Episode { scene, motion, .. } = episode;
        let physics = Arc::new(Physics::stated(scene));
        let job = Job { start: scene.start(), motion: motion.clone(), physics };
        Simulator::new(self.engine, Rate::DEFAULT).run(scene, &job, Record::Frames).frames
    }

    /// A scene as the observer is told of it.
    pub(super) fn told(&self, mut scene: Scene) -> Scene {
        if self.misled {
            let [objects, table] = FRICTIONS;
            for object in &mut scene.objects {
                object.friction *= objects;
                object.mass = MASS;
            }
            scene.frictions.iter_mut().for_each(|pair| pair.coefficient *= objects);
            scene.table_friction *= table;
        }
        scene
    }
}
