//! The engine with its step that plays lever-ups.

use std::num::NonZeroU16;
use std::sync::Arc;

use crate::progress::Progress;
use crate::{
    outcome::{Frame, LeverTrajectory, Record, Trajectory},
    scene::{Engine, LeverScene, ModelKind, ModelSpec, Rate, Scene, Situation},
    task::{LeverJob, Motion},
};

use super::play::{Film, play, play_all};
use super::scenery::Scenery;

/// Time between two recorded frames, seconds.
const FRAME: f64 = 0.02;

/// A simulator of lever-ups; it holds no state between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeverSimulator {
    /// Minimum number of steps a second; frames are divided into equal steps.
    pub rate: Rate,
}

impl LeverSimulator {
    /// Simulator for search: 60 steps a second.
    pub const COARSE: Self = Self::per_second(60);
    /// Simulator for data and checks: 240 steps a second.
    pub const FINE: Self = Self::per_second(240);
    /// Reference simulator: 1920 steps a second.
    pub const TRUTH: Self = Self::per_second(1920);

    /// Creates a simulator with this number of steps a second, at least one.
    pub const fn per_second(steps: u16) -> Self {
        Self { rate: Rate(NonZeroU16::MIN.saturating_add(steps.saturating_sub(1))) }
    }

    /// Plays a job until everything rests.
    ///
    /// A jam ends it at once; the remaining frames repeat the last pose.
    pub fn run(&self, job: &LeverJob) -> LeverTrajectory {
        self.run_as_planned(job, &job.scene)
    }

    /// Plays a job as [`LeverSimulator::run`], with the blade at its place in `planned`, in which
    /// objects may have slightly other poses than in reality.
    pub fn run_as_planned(&self, job: &LeverJob, planned: &LeverScene) -> LeverTrajectory {
        play(job, planned, self.rate.step(), None).0
    }

    /// Plays a job as [`LeverSimulator::run`] and records a frame every `interval` seconds, with
    /// the force on the blade, newtons.
    pub fn record(&self, job: &LeverJob, interval: f64) -> (LeverTrajectory, Vec<(Frame, f64)>) {
        play(job, &job.scene, self.rate.step(), Some(Film { frames: Vec::new(), interval }))
    }

    /// Plays consecutive motions in one world, from the real situation `really`, until everything
    /// rests. The motions follow the poses of `planned`, where the objects were expected.
    pub fn run_all(
        &self,
        really: &Situation,
        planned: &Scene,
        motions: &[Motion],
        (record, progress): (Record, &dyn Progress),
    ) -> Trajectory {
        let scenery = Arc::new(Scenery::new(really, planned));
        let film = Film { frames: Vec::new(), interval: FRAME };
        let film = (record == Record::Frames).then_some(film);
        let began = (Trajectory::new(self.spec()), progress);
        play_all(&scenery, motions, self.rate.step(), film, began)
    }

    /// Returns its identifier as an effect model.
    pub fn spec(&self) -> ModelSpec {
        ModelKind::Simulated { engine: Engine::Spatial, rate: self.rate }.into()
    }
}

impl Default for LeverSimulator {
    fn default() -> Self {
        Self::FINE
    }
}
