//! The interface of a model of lever-ups: jobs in, trajectories out.

use std::sync::Arc;

use crate::{
    outcome::LeverTrajectory,
    scene::{ModelKind, ModelSpec},
    task::LeverJob,
};

/// How far a model is to be trusted with a lever-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LeverTrust {
    /// The job is for this model.
    Mine {
        /// 95th percentile of its errors on held-out lever-ups like this one, metres: the root
        /// mean square over the frames of the centre's distance. `None` where it was not measured.
        p95: Option<f64>,
    },
    /// The job is for another model: this one leaves out something that matters.
    NotMine,
}

/// Predicts what lever-ups do.
///
/// Implementations run a batch of jobs in parallel on the current rayon pool and return the
/// same bits for any number of threads, trajectories in the order of the jobs.
pub trait LeverModel: Send + Sync {
    /// What it is, as users name it: `prior`, `3d,step=1/60`.
    fn name(&self) -> String;

    /// What it is as an effect model.
    fn spec(&self) -> ModelSpec {
        ModelKind::NETWORK.into()
    }

    /// How far it is to be trusted with a job.
    fn trust(&self, job: &LeverJob) -> LeverTrust;

    /// Rolls every job out until everything rests.
    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory>;
}

/// A pointer to a model is one itself.
macro_rules! models_behind {
    ($($pointer:ident),*) => {$(
        impl<M: LeverModel + ?Sized> LeverModel for $pointer<M> {
            fn name(&self) -> String {
                (**self).name()
            }

            fn spec(&self) -> ModelSpec {
                (**self).spec()
            }

            fn trust(&self, job: &LeverJob) -> LeverTrust {
                (**self).trust(job)
            }

            fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
                (**self).rollout(jobs)
            }
        }
    )*};
}

models_behind!(Arc, Box);
