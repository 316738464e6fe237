//! Models of lever-ups for training and comparison: one object followed through one lever-up.

use std::sync::Arc;

use rayon::prelude::*;

use pushplan::internals::effect::{LeverNetwork, LeverPrior, PriorSettings};
use pushplan::internals::outcome::LeverTrajectory;
use pushplan::internals::sim::LeverSimulator;
use pushplan::internals::task::LeverJob;

/// Model that predicts lever-ups.
///
/// Implementations run a batch of jobs in parallel on the current rayon pool and return the
/// same bits for any number of threads, trajectories in the order of the jobs.
pub trait LeverModel: Send + Sync {
    /// Returns the name in a comparison.
    fn name(&self) -> String;

    /// Returns `true` if the model covers all relevant effects of `job`.
    fn takes(&self, job: &LeverJob) -> bool;

    /// Predicts every job until all objects rest.
    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory>;
}

/// Implements [`LeverModel`] for a pointer to a model.
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

/// Simulator as a model: the ground truth, or a more expensive baseline.
#[derive(Clone, Copy, Debug)]
pub struct SimulatedLevers {
    /// Engine with its time step.
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
