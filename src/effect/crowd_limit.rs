//! A model limited to jobs with few objects in reach.

use crate::rollout::reachable;
use crate::{
    outcome::{Record, Trajectory},
    scene::{ModelSpec, Scene},
    task::Job,
};

use super::{EffectModel, Trust};

/// A model for motions that reach few objects, because the cost of its contacts grows faster with
/// their number than an engine's.
#[derive(Clone, Debug)]
pub struct CrowdLimit<M> {
    model: M,
    most: u16,
    spec: ModelSpec,
}

impl<M: EffectModel> CrowdLimit<M> {
    /// Limits `model` to motions that can set at most `most` objects in motion.
    pub fn new(model: M, most: u16) -> Self {
        let spec = model.spec().clone().up_to(most);
        Self { model, most, spec }
    }

    fn is_few(&self, scene: &Scene, job: &Job) -> bool {
        let most = usize::from(self.most);
        scene.objects.len() <= most || reachable(scene, job).len() <= most
    }
}

impl<M: EffectModel> EffectModel for CrowdLimit<M> {
    fn spec(&self) -> &ModelSpec {
        &self.spec
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        if self.is_few(scene, job) { self.model.trust(scene, job) } else { Trust::NotMine }
    }

    fn takes(&self, scene: &Scene, job: &Job) -> bool {
        self.is_few(scene, job) && self.model.takes(scene, job)
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        self.model.rollout(scene, jobs, record)
    }
}
