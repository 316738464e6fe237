//! The analytic model as an effect model: the closed-form solution of every frame, uncorrected.

use rayon::prelude::*;

use crate::{
    outcome::{Record, Trajectory},
    rollout::{RollSettings, Roller, reachable},
    scene::{ModelKind, ModelSpec, Scene, Stride},
    task::Job,
};

use super::{EffectModel, PRIOR_RANGES, Trust, measured::measured, trust::outside};

/// Number of jobs that one thread rolls out on the same memory: few enough that two cores share a
/// coarse search evenly.
const CHUNK: usize = 32;

/// The analytic model without any network: the cheapest model with physics.
#[derive(Clone, Debug)]
pub struct Prior {
    spec: ModelSpec,
    settings: RollSettings,
}

impl Prior {
    /// Creates the analytic model with `stride` frames predicted as one.
    pub fn new(stride: Stride) -> Self {
        let settings = RollSettings { stride: stride.frames(), ..RollSettings::default() };
        Self { spec: ModelKind::Prior { stride }.into(), settings }
    }
}

impl Default for Prior {
    fn default() -> Self {
        Self::new(Stride::ONE)
    }
}

impl EffectModel for Prior {
    fn spec(&self) -> &ModelSpec {
        &self.spec
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        if job.in_space() {
            return Trust::NotMine;
        }
        let error = measured(&self.spec.first().kind, || reachable(scene, job).len());
        Trust::Mine { error, warnings: outside(&PRIOR_RANGES, scene, job) }
    }

    fn takes(&self, _: &Scene, job: &Job) -> bool {
        !job.in_space()
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_chunks(CHUNK)
            .map_init(
                || Roller::new(self.spec.clone(), self.settings),
                |roller, chunk| roller.roll(scene, chunk, record, None),
            )
            .flatten_iter()
            .collect()
    }
}
