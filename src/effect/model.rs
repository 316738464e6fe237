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
/// Implementations run a batch of jobs in parallel on the current rayon pool and return the
/// same bits for any number of threads, trajectories in the order of the jobs.
pub trait EffectModel: Send + Sync {
    /// What it is.
    fn spec(&self) -> &ModelSpec;

    /// How far it is to be trusted with a job.
    fn trust(&self, scene: &Scene, job: &Job) -> Trust;

    /// Whether the model takes `job` at all: [`EffectModel::trust`] without errors and warnings,
    /// as every rollout asks for it.
    fn takes(&self, scene: &Scene, job: &Job) -> bool {
        self.trust(scene, job) != Trust::NotMine
    }

    /// Rolls every job out until everything rests. Every trajectory says which model made it,
    /// which may be one of several that this one chooses among.
    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory>;

    /// Rolls jobs out in turn as one trajectory, see [`in_turn`]; nothing without jobs.
    fn in_turn(&self, scene: &Scene, jobs: &[Job], record: Record) -> Option<Trajectory> {
        in_turn(&[jobs.to_vec()], record, |jobs| self.rollout(scene, jobs, record)).pop()
    }
}

/// A pointer to a model is one itself.
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
