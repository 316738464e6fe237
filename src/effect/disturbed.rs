//! A model that is told slightly wrong numbers: wrong friction, or a start that is a little off.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::{
    geometry::Vector,
    scene::{Physics, Record, Scene, State, ToolMotion, Trajectory, Warning},
};

use super::{EffectModel, Job};

/// What is wrong with the numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mistake {
    /// All friction values, the table's and the tool's included, times this factor.
    Friction(f64),
    /// Every object's start shifted by this many metres in a random direction; objects that
    /// joints connect move together, so that the joints still hold.
    Start(f64),
}

impl Mistake {
    fn title(self) -> String {
        match self {
            Mistake::Friction(factor) => format!("friction x {factor}"),
            Mistake::Start(metres) => format!("start off by {} mm", metres * 1e3),
        }
    }

    fn apply(self, job: &Job) -> Job {
        match self {
            Mistake::Friction(factor) => {
                let mut wrong = job.clone();
                let physics = Arc::make_mut(&mut wrong.physics);
                physics.frictions.iter_mut().for_each(|friction| *friction *= factor);
                physics.table_friction *= factor;
                Arc::make_mut(&mut wrong.motion.tool).friction *= factor;
                wrong
            }
            Mistake::Start(metres) => {
                let mut rng = directions(&job.start);
                let start = shifted_start(&job.start, &job.physics, metres, &mut rng);
                Job { start, ..job.clone() }
            }
        }
    }
}

/// A model that makes a [`Mistake`]: `planar, friction x 0.7`.
///
/// The simulator with a slightly shifted start shows its own spread: errors that no model can
/// be expected to undercut.
#[derive(Clone, Debug)]
pub struct Disturbed<M> {
    model: M,
    mistake: Mistake,
    name: String,
}

impl<M: EffectModel> Disturbed<M> {
    /// `model`, which makes this mistake in every rollout.
    pub fn new(model: M, mistake: Mistake) -> Self {
        let name = format!("{}, {}", model.name(), mistake.title());
        Self { model, mistake, name }
    }
}

impl<M: EffectModel> EffectModel for Disturbed<M> {
    fn name(&self) -> &str {
        &self.name
    }

    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
        self.model.warnings(scene, motion)
    }

    /// Unknown: measured errors are those with the true numbers.
    fn error_p95(&self) -> f64 {
        f64::INFINITY
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        let jobs: Vec<Job> = jobs.iter().map(|job| self.mistake.apply(job)).collect();
        self.model.rollout(scene, &jobs, record)
    }
}

/// A start with every object shifted by `metres` in a random direction; objects that joints
/// connect move together, so that the joints still hold.
pub fn shifted_start(start: &State, physics: &Physics, metres: f64, rng: &mut Pcg64) -> State {
    let shifts: Vec<Vector> = start
        .poses
        .iter()
        .map(|_| {
            let angle = rng.random_range(0.0..std::f64::consts::TAU);
            metres * Vector::new(angle.cos(), angle.sin())
        })
        .collect();
    let mut state = start.clone();
    for (pose, group) in state.poses.iter_mut().zip(physics.groups(|_| true)) {
        pose.position += shifts[group];
    }
    state
}

/// Directions come from the start itself, so that a job gives the same trajectory whatever jobs
/// stand beside it.
fn directions(start: &State) -> Pcg64 {
    Pcg64::seed_from_u64(start.poses.iter().fold(0u64, |seed, pose| {
        (seed ^ pose.position.x.to_bits() ^ pose.position.y.to_bits().rotate_left(32))
            .wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }))
}
