//! The engine with its step, playing lever-ups.

use std::num::NonZeroU16;

use crate::scene::{LeverJob, LeverMotion, LeverScene, LeverTrajectory, Rate, ToolMotion};

use super::play::{Watcher, play};

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
        play(job, &job.scene, self.rate.step(), (None, &mut Watcher::Nobody))
    }

    /// [`LeverSimulator::run`] with a blade that goes where it would in the scene as `planned`: what
    /// really lies there lies a little elsewhere.
    pub fn run_as_planned(&self, job: &LeverJob, planned: &LeverScene) -> LeverTrajectory {
        play(job, planned, self.rate.step(), (None, &mut Watcher::Nobody))
    }

    /// [`LeverSimulator::run_as_planned`], and then the pushes of `follow_up` among what lies where
    /// it came to rest: the trajectory's rest is that after the last of them.
    pub fn run_with(
        &self,
        job: &LeverJob,
        planned: &LeverScene,
        follow_up: Option<&ToolMotion>,
    ) -> LeverTrajectory {
        play(job, planned, self.rate.step(), (follow_up, &mut Watcher::Nobody))
    }

    /// [`LeverSimulator::run`], with everything that moved, every `interval` seconds.
    pub fn record(&self, job: &LeverJob, interval: f64) -> (LeverTrajectory, LeverMotion) {
        let mut motion = LeverMotion { frames: Vec::new() };
        let mut watcher = Watcher::Recorder { motion: &mut motion, interval };
        let trajectory = play(job, &job.scene, self.rate.step(), (None, &mut watcher));
        (trajectory, motion)
    }
}

impl Default for LeverSimulator {
    fn default() -> Self {
        Self::FINE
    }
}
