//! Trust in a model for a job.

use crate::rollout::reachable;
use crate::{
    outcome::Warning,
    scene::{Ranges, Scene},
    task::Job,
};

use super::Quantiles;

/// A model's assessment of a job before its rollout.
#[derive(Clone, Debug, PartialEq)]
pub enum Trust {
    /// The model accepts the job.
    Mine {
        /// Errors of the model on similar held-out pushes, if measured.
        error: Option<Quantiles>,
        /// Reasons for less trust; empty within the model's ranges.
        warnings: Vec<Warning>,
    },
    /// The model declines the job.
    NotMine,
}

impl Trust {
    /// Returns the warnings; none for a declined job.
    pub fn warnings(self) -> Vec<Warning> {
        match self {
            Trust::Mine { warnings, .. } => warnings,
            Trust::NotMine => Vec::new(),
        }
    }

    /// Returns the measured errors, if the model accepts the job and they exist.
    pub fn error(&self) -> Option<Quantiles> {
        match self {
            Trust::Mine { error, .. } => *error,
            Trust::NotMine => None,
        }
    }
}

/// Returns warnings for tool, motion and reachable objects of a job outside `ranges`.
pub(super) fn outside(ranges: &Ranges, scene: &Scene, job: &Job) -> Vec<Warning> {
    let found = ranges.warnings(scene, job);
    if found.is_empty() {
        return found;
    }
    // Objects that the motion cannot reach do not affect the prediction.
    ranges.warnings_among(scene, job, &reachable(scene, job))
}
