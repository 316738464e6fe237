//! The analytic model as a model of lever-ups.

use std::sync::LazyLock;

use rayon::prelude::*;

use crate::effect::lever::courses;
use crate::effect::{EffectModel, Trust};
use crate::geometry::Pose3;
use crate::outcome::{LeverTrajectory, Record, Trajectory};
use crate::scene::{ModelKind, ModelSpec, Scene};
use crate::task::{Job, LeverJob};

use super::settings::PriorSettings;
use super::setup::Setup;
use super::time_steps::TimeSteps;

/// The analytic model of lever-ups alone: the cheapest model with physics.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeverPrior {
    /// Resolution of the computation.
    pub settings: PriorSettings,
}

impl LeverPrior {
    /// Returns the poses of the plate at these times, seconds from the start of the rotation and in
    /// order, until it rests. The last pose then holds for the remaining times.
    pub fn follow(&self, job: &LeverJob, times: impl Iterator<Item = f64>) -> Vec<Pose3> {
        let setup = Setup::new(job);
        TimeSteps::default().follow(&setup, &self.settings_for(&setup), times)
    }

    fn settings_for(&self, setup: &Setup) -> PriorSettings {
        if setup.blocks.is_empty() { self.settings } else { self.settings.among_blocks() }
    }

    /// Returns `true` for supported lever-ups: of one object, and among blocks only of an object
    /// whose solids are cuboids.
    pub fn knows(&self, job: &LeverJob) -> bool {
        let [plate] = &job.scene.plates[..] else { return false };
        // Contacts with blocks are only found between cuboids.
        let cuboids = || plate.slabs.iter().all(|slab| slab.rectangle().is_some());
        job.scene.blocks.is_empty() || cuboids()
    }

    /// Computes lever-ups until everything rests.
    pub fn courses(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        jobs.par_iter()
            .map_init(TimeSteps::default, |marcher, job| {
                let setup = Setup::new(job);
                marcher.march(&setup, &self.settings_for(&setup))
            })
            .collect()
    }
}

impl EffectModel for LeverPrior {
    fn spec(&self) -> &ModelSpec {
        static SPEC: LazyLock<ModelSpec> = LazyLock::new(|| ModelKind::PRIOR.into());
        &SPEC
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        courses::trust(scene, job, |job| self.knows(job))
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        courses::rollout(self.spec(), (scene, jobs), record, |jobs| self.courses(jobs))
    }
}
