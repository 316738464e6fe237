//! The door: an engine with its step, playing tool motions.

use crate::scene::{Engine, Job, Record, Scene, Trajectory};

use super::drive::drive;
use super::planar::PlanarWorld;
use super::spatial::SpatialWorld;

/// Longest time step of either engine, seconds.
///
/// At 1/240 s a 20 cm push at 0.1 m/s in the planar engine ends 0.06 mm (cylinders) and 0.2 mm
/// (cuboids, median) from its own fine run; the 3-D engine is about 4 mm from another good
/// engine on boxes.
pub const DEFAULT_STEP: f64 = 1.0 / 240.0;

/// A physics engine with its settings. Plays motions; holds no state between them.
///
/// ```
/// use std::sync::Arc;
/// use pushplan::{
///     Job, Object, Part, Pose, Push, Record, Scene, Simulator, Tool, ToolMotion, Vector,
/// };
///
/// let scene = Scene::new([Object::cylinder("can", 0.05, 0.1).at(0.2, 0.0, 0.0)]);
/// let bar = Part::cuboid("bar", [0.02, 0.2, 0.05], Pose::default());
/// let tool = Arc::new(Tool::new("bar", [bar])?);
/// let push = Push { start: Vector::zeros(), direction: 0.0, length: 0.2, speed: 0.1 };
/// let motion = ToolMotion::pushes(tool, 0.002, 0.0, &[push], true);
///
/// let trajectory = Simulator::planar().run(&scene, &Job::stated(&scene, motion), Record::Outcome);
/// assert!((trajectory.outcome().poses[0].position.x - 0.26).abs() < 2e-3);
/// # Ok::<(), pushplan::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Simulator {
    engine: Engine,
    step: f64,
}

impl Simulator {
    /// The planar engine at its default step.
    pub fn planar() -> Self {
        Self::planar_with_step(DEFAULT_STEP)
    }

    /// The planar engine with steps of at most `step` seconds.
    pub fn planar_with_step(step: f64) -> Self {
        Self { engine: Engine::Planar, step }
    }

    /// The 3-D engine at its default step.
    pub fn spatial() -> Self {
        Self::spatial_with_step(DEFAULT_STEP)
    }

    /// The 3-D engine with steps of at most `step` seconds.
    pub fn spatial_with_step(step: f64) -> Self {
        Self { engine: Engine::Spatial, step }
    }

    /// Which engine this is.
    pub fn engine(&self) -> Engine {
        self.engine
    }

    /// Longest time step, seconds.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Plays a job until everything rests.
    ///
    /// The trajectory always has at least one frame; what went wrong on the way stands in its
    /// warnings.
    pub fn run(&self, scene: &Scene, job: &Job, record: Record) -> Trajectory {
        let play = match self.engine {
            Engine::Planar => drive::<PlanarWorld>,
            Engine::Spatial => drive::<SpatialWorld>,
        };
        play(scene, job, self.step, record)
    }
}
