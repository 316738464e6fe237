//! The network of parts as a model of lever-ups.

use rayon::prelude::*;

use pushplan::internals::effect::{LeverPrior, PriorSettings};
use pushplan::internals::network::Forward;
use pushplan::internals::{outcome::LeverTrajectory, task::LeverJob};
use pushplan_learn::lever_model::LeverModel;

use super::card::PartsWeights;
use super::course::LeverCourse;
use super::walk::{Walk, Walker};

/// Number of lever-ups that share the matrix products of a step. Fixed, so that two cores share a
/// search evenly.
const AT_ONCE: usize = 32;

/// Model of cuboid bodies with trained weights.
#[derive(Clone, Debug)]
pub struct LeverParts {
    forward: Forward,
    prior: Option<LeverPrior>,
}

impl LeverParts {
    /// Analytic model that the network corrects.
    pub const PRIOR: LeverPrior = LeverPrior { settings: PriorSettings::CORRECTED };

    /// Creates the model of these weights.
    pub fn new(weights: &PartsWeights) -> Self {
        let card = &weights.card;
        Self {
            forward: Forward::of(&card.config, &card.normaliser, &weights.parameters),
            prior: card.prior.then_some(Self::PRIOR),
        }
    }

    fn roll(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        let course = |job| LeverCourse::new(job, self.prior.as_ref());
        let courses: Vec<Option<LeverCourse>> = jobs.iter().map(course).collect();
        let mut walks: Vec<Walk<'_>> = courses.iter().flatten().map(Walk::new).collect();
        let mut walker = Walker::new(&self.forward);
        while walker.step(&mut walks) {}
        let mut walks = walks.into_iter();
        // Jobs outside the network's domain are answered by the analytic model.
        let other = |job: &LeverJob| Self::PRIOR.rollout(std::slice::from_ref(job)).pop();
        let answer = |(job, course): (&LeverJob, &Option<LeverCourse>)| match course {
            Some(_) => walks.next().map(Walk::trajectory),
            None => other(job),
        };
        jobs.iter().zip(&courses).filter_map(answer).collect()
    }
}

impl LeverModel for LeverParts {
    fn name(&self) -> String {
        let prior = if self.prior.is_some() { "prior + " } else { "" };
        format!("{prior}propagation network, parts")
    }

    fn takes(&self, job: &LeverJob) -> bool {
        LeverCourse::new(job, None).is_some() && !job.scene.blocks.is_empty()
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        jobs.par_chunks(AT_ONCE).flat_map_iter(|jobs| self.roll(jobs)).collect()
    }
}
