//! The 3-D engine as a model of lever-ups.

use rayon::prelude::*;

use crate::sim::LeverSimulator;
use crate::{outcome::LeverTrajectory, scene::ModelSpec, task::LeverJob};

use super::{LeverModel, LeverTrust};

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

    fn spec(&self) -> ModelSpec {
        self.simulator.spec()
    }

    fn trust(&self, _: &LeverJob) -> LeverTrust {
        LeverTrust::Mine { p95: None }
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        jobs.par_iter().map(|job| self.simulator.run(job)).collect()
    }
}
