//! A model whose assumptions about a scene differ from the statements of its jobs.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::{
    geometry::Vector,
    outcome::{Record, Trajectory},
    scene::{Assumptions, JointBelief, ModelSpec, Physics, Scene, State},
    task::Job,
};

use super::{EffectModel, Trust};

/// A model under assumptions: `network,joints=none`, `planar,friction=70%`.
///
/// The simulator with a slightly shifted start shows its own spread, a lower bound on the error of
/// any model.
#[derive(Clone, Debug)]
pub struct Assuming<M> {
    model: M,
    assumptions: Assumptions,
    spec: ModelSpec,
}

impl<M: EffectModel> Assuming<M> {
    /// Applies `assumptions` to `model` in every rollout.
    pub fn new(model: M, assumptions: Assumptions) -> Self {
        let spec = model.spec().clone().assuming(assumptions);
        Self { model, assumptions, spec }
    }
}

impl<M: EffectModel> EffectModel for Assuming<M> {
    fn spec(&self) -> &ModelSpec {
        &self.spec
    }

    /// Returns the trust without errors, because these were measured with true values.
    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        match self.model.trust(scene, &under_assumptions(self.assumptions, scene, job)) {
            Trust::Mine { warnings, .. } => Trust::Mine { error: None, warnings },
            Trust::NotMine => Trust::NotMine,
        }
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        let jobs: Vec<Job> =
            jobs.iter().map(|job| under_assumptions(self.assumptions, scene, job)).collect();
        let mut rolled = self.model.rollout(scene, &jobs, record);
        for trajectory in &mut rolled {
            trajectory.by = trajectory.by.clone().assuming(self.assumptions);
        }
        rolled
    }
}

/// Returns the job under these assumptions.
fn under_assumptions(assumptions: Assumptions, scene: &Scene, job: &Job) -> Job {
    let Assumptions { joints, friction, start } = assumptions;
    let mut job = job.clone();
    if let Some(belief) = joints {
        job.physics = Arc::new(match belief {
            JointBelief::None => job.physics.without_joints(),
            JointBelief::Guessed => job.physics.guess_joints(scene),
            JointBelief::Fixed => job.physics.with_contacts_fixed(scene),
        });
    }
    if let Some(percent) = friction {
        let factor = f64::from(percent) / 100.0;
        let physics = Arc::make_mut(&mut job.physics);
        physics.frictions.iter_mut().for_each(|friction| *friction *= factor);
        physics.table_friction *= factor;
        physics.pairs.iter_mut().for_each(|pair| pair.coefficient *= factor);
        Arc::make_mut(&mut job.motion.slide_mut().tool).friction *= factor;
    }
    if let Some(micrometres) = start {
        let mut rng = directions(&job.start);
        job.start = shifted_start(&job.start, &job.physics, f64::from(micrometres) / 1e6, &mut rng);
    }
    job
}

/// Shifts every object of a start by `metres` in a random direction. Objects connected by joints
/// move together, so that the joints still hold.
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

/// Creates a generator from the start itself, so that the trajectory of a job does not depend on
/// the other jobs.
fn directions(start: &State) -> Pcg64 {
    Pcg64::seed_from_u64(start.poses.iter().fold(0u64, |seed, pose| {
        (seed ^ pose.position.x.to_bits() ^ pose.position.y.to_bits().rotate_left(32))
            .wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }))
}
