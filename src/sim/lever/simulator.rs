//! The engine with its step, playing lever-ups.

use std::num::NonZeroU16;
use std::sync::Arc;

use crate::watch::Watch;
use crate::{
    outcome::{Frame, LeverTrajectory, Record, Trajectory},
    scene::{Engine, LeverScene, ModelKind, ModelSpec, Rate, Scene, Situation},
    task::{LeverJob, Motion},
};

use super::play::{Film, play, play_all};
use super::scenery::Scenery;

/// Between two frames that are recorded, seconds.
const FRAME: f64 = 0.02;

/// Simulates lever-ups; holds no state between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeverSimulator {
    /// At least so many steps a second; frames are cut into equal steps.
    pub rate: Rate,
}

impl LeverSimulator {
    /// 60 steps a second: for search.
    pub const COARSE: Self = Self::per_second(60);
    /// 240 steps a second: data and checks.
    pub const FINE: Self = Self::per_second(240);
    /// 1920 steps a second: what the others are measured against.
    pub const TRUTH: Self = Self::per_second(1920);

    /// So many steps a second, and at least one.
    pub const fn per_second(steps: u16) -> Self {
        Self { rate: Rate(NonZeroU16::MIN.saturating_add(steps.saturating_sub(1))) }
    }

    /// Plays a job until everything rests.
    ///
    /// What is jammed ends it at once: the frames that are left repeat the last pose.
    pub fn run(&self, job: &LeverJob) -> LeverTrajectory {
        self.run_as_planned(job, &job.scene)
    }

    /// [`LeverSimulator::run`] with a blade that goes where it would in the scene as `planned`: what
    /// really lies there lies a little elsewhere.
    pub fn run_as_planned(&self, job: &LeverJob, planned: &LeverScene) -> LeverTrajectory {
        play(job, planned, self.rate.step(), None).0
    }

    /// [`LeverSimulator::run`], with a frame every `interval` seconds and the force on the blade in it,
    /// newtons.
    pub fn record(&self, job: &LeverJob, interval: f64) -> (LeverTrajectory, Vec<(Frame, f64)>) {
        play(job, &job.scene, self.rate.step(), Some(Film { frames: Vec::new(), interval }))
    }

    /// Plays motions one after another in one world, from the situation as it `really` is, until
    /// everything rests. The motions go where they would in the scene as `planned`, where the objects
    /// were expected.
    pub fn run_all(
        &self,
        really: &Situation,
        planned: &Scene,
        motions: &[Motion],
        (record, watch): (Record, &dyn Watch),
    ) -> Trajectory {
        let scenery = Arc::new(Scenery::new(really, planned));
        let film = Film { frames: Vec::new(), interval: FRAME };
        let film = (record == Record::Frames).then_some(film);
        let began = (Trajectory::new(self.spec()), watch);
        play_all(&scenery, motions, self.rate.step(), film, began)
    }

    /// What it is as an effect model.
    pub fn spec(&self) -> ModelSpec {
        ModelKind::Simulated { engine: Engine::Spatial, rate: self.rate }.into()
    }
}

impl Default for LeverSimulator {
    fn default() -> Self {
        Self::FINE
    }
}
