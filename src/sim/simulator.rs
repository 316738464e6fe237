//! The simulator: an engine with its step that plays tool motions.

use std::sync::Arc;

use crate::geometry::Pose;
use crate::progress::{NoProgress, Progress};
use crate::{
    outcome::{Record, Trajectory, in_turn},
    scene::{Engine, ModelKind, ModelSpec, Rate, Scene, Situation},
    task::{Job, Motion},
};

use super::lever::LeverSimulator;
use super::planar::PlanarWorld;
use super::playback::{Arm, playback};
use super::spatial::SpatialWorld;

/// A physics engine with its settings. It plays motions and holds no state between them.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Simulator {
    engine: Engine,
    rate: Rate,
    retreats: bool,
}

impl Simulator {
    /// Creates an engine with at least `rate` steps a second.
    pub const fn new(engine: Engine, rate: Rate) -> Self {
        Self { engine, rate, retreats: false }
    }

    /// Lets tools [retreat](crate::task::ToolMotion::retreat) before they are lifted.
    pub const fn retreating(self) -> Self {
        Self { retreats: true, ..self }
    }

    /// Returns `true` if tools retreat before they are lifted.
    pub fn retreats(&self) -> bool {
        self.retreats
    }

    /// Creates the 2-D engine at its default step.
    pub const fn planar() -> Self {
        Self::new(Engine::Planar, Rate::DEFAULT)
    }

    /// Creates the 3-D engine at its default step.
    pub const fn spatial() -> Self {
        Self::new(Engine::Spatial, Rate::DEFAULT)
    }

    /// Creates the 3-D engine in which nothing tips, at its default step.
    pub const fn upright() -> Self {
        Self::new(Engine::Upright, Rate::DEFAULT)
    }

    /// Returns the engine.
    pub fn engine(&self) -> Engine {
        self.engine
    }

    /// Returns the longest time step, seconds.
    pub fn step(&self) -> f64 {
        self.rate.step()
    }

    /// Returns its identifier as an effect model.
    pub fn spec(&self) -> ModelSpec {
        ModelKind::Simulated { engine: self.engine, rate: self.rate }.into()
    }

    /// Plays a job until everything rests.
    ///
    /// The trajectory always has at least one frame; problems are reported as warnings.
    pub fn run(&self, scene: &Scene, job: &Job, record: Record) -> Trajectory {
        self.run_watched(scene, job, record, &NoProgress)
    }

    /// Plays a job as [`Simulator::run`]; `progress` can stop it after any frame, with a warning.
    pub fn run_watched(
        &self,
        scene: &Scene,
        job: &Job,
        record: Record,
        progress: &dyn Progress,
    ) -> Trajectory {
        if job.in_space() {
            return self.in_space(scene, job, record, progress);
        }
        self.playback(scene, job, record, (None, progress))
    }

    /// Plays consecutive jobs as one trajectory, see [`in_turn`].
    pub fn run_in_turn(
        &self,
        scene: &Scene,
        jobs: &[Job],
        record: Record,
        progress: &dyn Progress,
    ) -> Trajectory {
        let run = |job: &Job| self.run_watched(scene, job, record, progress);
        let made = in_turn(&[jobs.to_vec()], record, |jobs| jobs.iter().map(run).collect());
        let standing = || Trajectory::standing(self.spec(), Pose::default(), scene.start());
        made.into_iter().next().unwrap_or_else(standing)
    }

    /// Plays a planar job as an arm executes it: it ends where the arm cannot continue, with a
    /// warning that states the reason.
    pub fn run_by(&self, arm: &Arm, scene: &Scene, job: &Job, record: Record) -> Trajectory {
        self.playback(scene, job, record, (Some(arm), &NoProgress))
    }

    fn playback(
        &self,
        scene: &Scene,
        job: &Job,
        record: Record,
        by: (Option<&Arm>, &dyn Progress),
    ) -> Trajectory {
        let play = match self.engine {
            Engine::Planar => playback::<PlanarWorld>,
            Engine::Spatial => playback::<SpatialWorld<true>>,
            Engine::Upright => playback::<SpatialWorld<false>>,
        };
        play(scene, job, self, record, by)
    }

    /// Plays consecutive motions until everything rests.
    pub fn run_plan(&self, scene: &Scene, motions: &[Motion], record: Record) -> Trajectory {
        match motions {
            [] => Trajectory::standing(self.spec(), Pose::default(), scene.start()),
            motions if !scene.in_space() && !motions.iter().any(Motion::is_lever) => {
                let job = |motion: &Motion| Job::stated(scene, motion.clone());
                let jobs: Vec<Job> = motions.iter().map(job).collect();
                self.run_in_turn(scene, &jobs, record, &NoProgress)
            }
            motions => {
                let simulator = LeverSimulator { rate: self.rate };
                let watched = (record, &NoProgress as _);
                simulator.run_all(&Situation::stated(scene), scene, motions, watched)
            }
        }
    }

    /// Returns `true` if it can play a job; only the 3-D engine can play jobs that leave the plane.
    pub fn takes(&self, job: &Job) -> bool {
        self.engine == Engine::Spatial || !job.in_space()
    }

    /// Plays a job that leaves the plane or starts out of it.
    fn in_space(
        &self,
        scene: &Scene,
        job: &Job,
        record: Record,
        progress: &dyn Progress,
    ) -> Trajectory {
        if !self.takes(job) || !job.motion.fits(scene) {
            return Trajectory::declined(&self.spec(), job);
        }
        let Job { start, motion, physics } = job.clone();
        let situation = Situation { scene: Arc::new(scene.clone()), start, physics };
        let simulator = LeverSimulator { rate: self.rate };
        simulator.run_all(&situation, scene, &[motion], (record, progress))
    }
}
