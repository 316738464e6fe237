//! The prior as a model of lever-ups.

use rayon::prelude::*;

use crate::effect::{LeverModel, LeverTrust};
use crate::geometry::Pose3;
use crate::{
    outcome::LeverTrajectory,
    scene::{ModelKind, ModelSpec},
    task::LeverJob,
};

use super::march::Marcher;
use super::settings::PriorSettings;
use super::setup::Setup;

/// The prior alone: the cheapest level with physics in it.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeverPrior {
    /// How finely it computes.
    pub settings: PriorSettings,
}

impl LeverPrior {
    /// Where the plate is at these times, seconds from the start of the turn and in order, until it rests;
    /// the last pose then holds for the others.
    pub fn follow(&self, job: &LeverJob, times: impl Iterator<Item = f64>) -> Vec<Pose3> {
        let setup = Setup::new(job);
        Marcher::default().follow(&setup, &self.settings_for(&setup), times)
    }

    fn settings_for(&self, setup: &Setup) -> PriorSettings {
        if setup.blocks.is_empty() { self.settings } else { self.settings.among_blocks() }
    }
}

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

    fn spec(&self) -> ModelSpec {
        ModelKind::PRIOR.into()
    }

    fn trust(&self, job: &LeverJob) -> LeverTrust {
        let [plate] = &job.scene.plates[..] else { return LeverTrust::NotMine };
        // Contacts with blocks are found between cuboids.
        let cuboids = || plate.slabs.iter().all(|slab| slab.rectangle().is_some());
        let takes = job.scene.blocks.is_empty() || cuboids();
        if takes { LeverTrust::Mine { p95: None } } else { LeverTrust::NotMine }
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        jobs.par_iter()
            .map_init(Marcher::default, |marcher, job| {
                let setup = Setup::new(job);
                marcher.march(&setup, &self.settings_for(&setup))
            })
            .collect()
    }
}
