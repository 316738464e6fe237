//! Simulation of trajectories, and prior knowledge of an observer about them.

use std::sync::Arc;

use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    outcome::{Frame, Record, Warning},
    scene::{Engine, Physics, Rate, Scene},
    task::Job,
};
use pushplan_learn::dataset::Episode;
use serde::{Deserialize, Serialize};

/// Factors by which friction values are misstated to an observer: of objects and pairs, and of the
/// table.
const FRICTIONS: [f64; 2] = [0.6, 1.3];

/// Mass misstated for every object, kg.
const MASS: f64 = 0.6;

/// Engine of trajectories, and whether the observer's numbers are wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Circumstances {
    /// Engine of the simulation.
    pub engine: Engine,
    /// Whether the observer has wrong numbers: 0.6 times the friction values of objects, 1.3 times
    /// the friction of the table, and 0.6 kg for every mass.
    pub misled: bool,
}

impl Circumstances {
    /// The 2-D engine and true numbers.
    pub const USUAL: Self = Self { engine: Engine::Planar, misled: false };

    /// Returns an episode's frames in this engine. Episodes are drawn with the 2-D engine, which
    /// has them. In another engine objects end elsewhere. The first stroke that begins inside an
    /// object would fling it away, and therefore ends the trajectory.
    pub(super) fn frames(&self, episode: &Episode) -> Vec<Frame> {
        if self.engine == Engine::Planar {
            return episode.frames.clone();
        }
        let Episode { scene, motion, .. } = episode;
        let physics = Arc::new(Physics::stated(scene));
        let job = Job { start: scene.start(), motion: motion.clone().into(), physics };
        let played = Simulator::new(self.engine, Rate::DEFAULT).run(scene, &job, Record::Frames);
        let set_down = played.warnings.iter().filter_map(|warning| match warning {
            Warning::SetDownOn { stroke, .. } => Some(*stroke),
            _ => None,
        });
        let strokes = set_down.min().unwrap_or(usize::MAX);
        played.frames.into_iter().take_while(|frame| frame.stroke < strokes).collect()
    }

    /// Returns a scene as stated to the observer.
    pub(super) fn stated(&self, mut scene: Scene) -> Scene {
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

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::internals::geometry::{Pose, Shape, Vector};
    use pushplan::internals::{
        scene::{Object, Part, Tool},
        task::{Push, ToolMotion},
    };

    #[test]
    fn a_stroke_that_begins_inside_an_object_ends_an_episode_in_another_engine() {
        let finger = Shape::Cylinder { radius: 0.01, height: 0.1 };
        let tool = Tool::new("finger", [Part::new("finger", finger, Pose::default())]);
        let tool = Arc::new(tool.expect("one piece"));
        let scene = Scene::new([Object::cylinder("can", 0.05, 0.1).at(0.1, 0.0, 0.0)]);
        let episode = |second: Vector| {
            let push = |start| Push { start, direction: 0.0, length: 0.1, speed: 0.1 };
            let pushes = [push(Vector::zeros()), push(second)];
            let motion = ToolMotion::pushes(Arc::clone(&tool), 0.01, 0.0, &pushes, true);
            Episode { index: 0, scene: scene.clone(), motion, frames: Vec::new() }
        };
        let strokes = |second| {
            let circumstances = Circumstances { engine: Engine::Spatial, misled: false };
            circumstances.frames(&episode(second)).last().map(|frame| frame.stroke)
        };
        // The first stroke leaves the can at 0.16.
        assert_eq!(strokes(Vector::new(0.05, 0.0)), Some(1));
        assert_eq!(strokes(Vector::new(0.15, 0.0)), Some(0));
    }
}
