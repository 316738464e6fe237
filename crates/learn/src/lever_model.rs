//! Models of lever-ups as they are trained and compared: one object followed through one lever-up.

use std::sync::Arc;

use rayon::prelude::*;

use pushplan::internals::effect::{LeverNetwork, LeverPrior, PriorSettings};
use pushplan::internals::outcome::LeverTrajectory;
use pushplan::internals::sim::LeverSimulator;
use pushplan::internals::task::LeverJob;

/// Predicts what lever-ups do.
///
/// Implementations run a batch of jobs in parallel on the current rayon pool and return the
/// same bits for any number of threads, trajectories in the order of the jobs.
pub trait LeverModel: Send + Sync {
    /// Name in a comparison.
    fn name(&self) -> String;

    /// Returns `true` if the model leaves out nothing that matters for `job`.
    fn takes(&self, job: &LeverJob) -> bool;

    /// Predicts every job until everything rests.
    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory>;
}

/// Makes a pointer to a model a model.
macro_rules! models_behind {
    ($($pointer:ident),*) => {$(
        impl<M: LeverModel + ?Sized> LeverModel for $pointer<M> {
            fn name(&self) -> String {
                (**self).name()
            }

            fn takes(&self, job: &LeverJob) -> bool {
                (**self).takes(job)
            }

            fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
                (**self).rollout(jobs)
            }
        }
    )*};
}

models_behind!(Arc, Box);

impl LeverModel for LeverPrior {
    fn name(&self) -> String {
        let PriorSettings { step, sweeps, inertia, .. } = self.settings;
        let usual = PriorSettings::default();
        let mut name = if inertia { "prior" } else { "prior from rest" }.to_owned();
        if step != usual.step {
            name += &format!(",step=1/{:.0}", 1.0 / step);
        }
        if inertia && sweeps != usual.sweeps {
            name += &format!(",sweeps={sweeps}");
        }
        name
    }

    fn takes(&self, job: &LeverJob) -> bool {
        self.knows(job)
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        self.courses(jobs)
    }
}

impl LeverModel for LeverNetwork {
    fn name(&self) -> String {
        self.describe()
    }

    fn takes(&self, job: &LeverJob) -> bool {
        self.knows(job)
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        self.courses(jobs)
    }
}

/// A simulator as a model: the most expensive levels of the ladder, and the truth of the others.
#[derive(Clone, Copy, Debug)]
pub struct SimulatedLevers {
    /// The engine with its step.
    pub simulator: LeverSimulator,
}

impl LeverModel for SimulatedLevers {
    fn name(&self) -> String {
        format!("3d,step=1/{}", self.simulator.rate.0)
    }

    fn takes(&self, _: &LeverJob) -> bool {
        true
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        jobs.par_iter().map(|job| self.simulator.run(job)).collect()
    }
}
