//! How far a model is to be trusted with a job.

use crate::rollout::reachable;
use crate::{
    outcome::Warning,
    scene::{Ranges, Scene},
    task::Job,
};

use super::Quantiles;

/// What a model says of a job before it rolls it out.
#[derive(Clone, Debug, PartialEq)]
pub enum Trust {
    /// The job is for this model.
    Mine {
        /// Its errors on held-out pushes like this one, if they were measured.
        error: Option<Quantiles>,
        /// What makes it less trustworthy here; empty within its ranges.
        warnings: Vec<Warning>,
    },
    /// The job is for another model.
    NotMine,
}

impl Trust {
    /// The warnings; none where the job is not the model's.
    pub fn warnings(self) -> Vec<Warning> {
        match self {
            Trust::Mine { warnings, .. } => warnings,
            Trust::NotMine => Vec::new(),
        }
    }

    /// The errors, if the job is the model's and they were measured.
    pub fn error(&self) -> Option<Quantiles> {
        match self {
            Trust::Mine { error, .. } => *error,
            Trust::NotMine => None,
        }
    }
}

/// Everything of a job that lies outside `ranges`: of the tool, the motion, and the objects that it
/// can reach.
pub(super) fn outside(ranges: &Ranges, scene: &Scene, job: &Job) -> Vec<Warning> {
    let found = ranges.warnings(scene, job);
    if found.is_empty() {
        return found;
    }
    // What the motion cannot reach is never looked at.
    ranges.warnings_among(scene, job, &reachable(scene, job))
}
