//! The interface of an effect model: jobs in, trajectories out.

use std::sync::Arc;

use crate::scene::{Job, Record, Scene, ToolMotion, Trajectory, Warning};

/// Predicts the effect of tool motions.
///
/// Implementations run a batch of jobs in parallel on the current rayon pool and return the
/// same bits for any number of threads, trajectories in the order of the jobs.
pub trait EffectModel: Send + Sync {
    /// Short name for tables, such as `brdpn-128` or `planar`.
    fn name(&self) -> &str;

    /// Name of what predicts this motion from the scene's start, where that may be another model
    /// than for others.
    fn name_for(&self, _scene: &Scene, _motion: &ToolMotion) -> &str {
        self.name()
    }

    /// What makes this model less trustworthy for this scene and motion; empty if nothing.
    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning>;

    /// 95th percentile of the final position error on held-out pushes, metres; 0 for a
    /// simulator that is its own truth.
    fn error_p95(&self) -> f64;

    /// Rolls every job out until everything rests.
    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory>;
}

/// What points to a model is one.
macro_rules! models_behind {
    ($($pointer:ident),*) => {$(
        impl<M: EffectModel + ?Sized> EffectModel for $pointer<M> {
            fn name(&self) -> &str {
                (**self).name()
            }

            fn name_for(&self, scene: &Scene, motion: &ToolMotion) -> &str {
                (**self).name_for(scene, motion)
            }

            fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
                (**self).warnings(scene, motion)
            }

            fn error_p95(&self) -> f64 {
                (**self).error_p95()
            }

            fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
                (**self).rollout(scene, jobs, record)
            }
        }
    )*};
}

models_behind!(Arc, Box);

/// The rollouts of those of `jobs` that `wanted` says, by `model`, into their places.
pub(super) fn fill(
    model: &dyn EffectModel,
    (scene, jobs, record): (&Scene, &[Job], Record),
    wanted: &[bool],
    places: &mut [Trajectory],
) {
    let few: Vec<Job> = jobs
        .iter()
        .zip(wanted)
        .filter(|(_, wanted)| **wanted)
        .map(|(job, _)| job.clone())
        .collect();
    let rolled = model.rollout(scene, &few, record);
    let places = places.iter_mut().zip(wanted).filter(|(_, wanted)| **wanted);
    for ((place, _), trajectory) in places.zip(rolled) {
        *place = trajectory;
    }
}
