//! Combination of a model of pushes and a model of lever-ups.

use std::sync::Arc;

use crate::outcome::{Record, Trajectory};
use crate::scene::{ModelSpec, Scene};
use crate::task::Job;

use super::{EffectModel, Trust};

/// Two models, each for its kind of motion; named after the model of pushes.
#[derive(Clone)]
pub struct ByMotion {
    pushes: Arc<dyn EffectModel>,
    levers: Arc<dyn EffectModel>,
}

impl ByMotion {
    /// Uses `pushes` for jobs that stay in the plane, `levers` for the others.
    pub fn new(pushes: Arc<dyn EffectModel>, levers: Arc<dyn EffectModel>) -> Self {
        Self { pushes, levers }
    }

    fn of(&self, job: &Job) -> &dyn EffectModel {
        if job.in_space() { &*self.levers } else { &*self.pushes }
    }
}

impl EffectModel for ByMotion {
    fn spec(&self) -> &ModelSpec {
        self.pushes.spec()
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        self.of(job).trust(scene, job)
    }

    fn takes(&self, scene: &Scene, job: &Job) -> bool {
        self.of(job).takes(scene, job)
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        if jobs.iter().all(|job| !job.in_space()) {
            return self.pushes.rollout(scene, jobs, record);
        }
        let (levers, pushes): (Vec<Job>, Vec<Job>) = jobs.iter().cloned().partition(Job::in_space);
        let mut levers = self.levers.rollout(scene, &levers, record).into_iter();
        let mut pushes = self.pushes.rollout(scene, &pushes, record).into_iter();
        let next = |job: &Job| if job.in_space() { levers.next() } else { pushes.next() };
        jobs.iter().filter_map(next).collect()
    }
}
