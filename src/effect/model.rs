//! The interface of an effect model: jobs in, trajectories out.

use std::sync::Arc;

use crate::{
    outcome::{Record, Trajectory, in_turn},
    scene::{ModelSpec, Scene},
    task::Job,
};

use super::Trust;

/// Predicts the effect of tool motions.
///
/// Implementations run a batch of jobs in parallel on the current rayon pool. The result has the
/// order of the jobs, with the same bits for any number of threads.
pub trait EffectModel: Send + Sync {
    /// Returns the model identifier and settings.
    fn spec(&self) -> &ModelSpec;

    /// Returns the trust in the model for a job.
    fn trust(&self, scene: &Scene, job: &Job) -> Trust;

    /// Returns `true` if the model accepts `job`: a cheap form of [`EffectModel::trust`] without
    /// errors and warnings, for every rollout.
    fn takes(&self, scene: &Scene, job: &Job) -> bool {
        self.trust(scene, job) != Trust::NotMine
    }

    /// Rolls every job out until everything rests. Every trajectory states the model that computed
    /// it, which may be one of several between which this model chooses.
    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory>;

    /// Rolls jobs out in turn as one trajectory, see [`in_turn`]; `None` without jobs.
    fn in_turn(&self, scene: &Scene, jobs: &[Job], record: Record) -> Option<Trajectory> {
        in_turn(&[jobs.to_vec()], record, |jobs| self.rollout(scene, jobs, record)).pop()
    }
}

/// Implements the trait for a pointer to a model.
macro_rules! models_behind {
    ($($pointer:ident),*) => {$(
        impl<M: EffectModel + ?Sized> EffectModel for $pointer<M> {
            fn spec(&self) -> &ModelSpec {
                (**self).spec()
            }

            fn trust(&self, scene: &Scene, job: &Job) -> Trust {
                (**self).trust(scene, job)
            }

            fn takes(&self, scene: &Scene, job: &Job) -> bool {
                (**self).takes(scene, job)
            }

            fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
                (**self).rollout(scene, jobs, record)
            }
        }
    )*};
}

models_behind!(Arc, Box);
