//! What was measured, as plain data.

use serde::{Deserialize, Serialize};

use crate::watch::Watch;
use crate::{
    effect::EffectModel,
    judge::{Drift, RelativeErrors, Trial},
};

use super::{
    family::{CrowdFamily, CrowdSet},
    measure::evaluate_crowd,
};

/// Errors of several models on one test set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrowdReport {
    /// A line for tables.
    pub title: String,
    /// The set's family.
    pub family: CrowdFamily,
    /// What the scenes hold; `None` for recordings.
    pub set: Option<CrowdSet>,
    /// Seed of the set; `None` for recordings.
    pub seed: Option<u64>,
    /// Number of trajectories.
    pub trajectories: usize,
    /// Mean number of compared frames in one of them.
    pub frames: f64,
    /// One entry a model, in the order in which they were given.
    pub models: Vec<CrowdModel>,
}

impl CrowdReport {
    /// Errors of `models` on the trajectories of a test set, drawn with `seed`; `watch` is told
    /// the rollouts of each that are done.
    pub fn of_set(
        set: &CrowdSet,
        seed: u64,
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        watch: &dyn Watch,
    ) -> Self {
        let report = Self::of_recordings(set.title(), trials, models, watch);
        Self { family: set.family, set: Some(*set), seed: Some(seed), ..report }
    }

    /// Errors of `models` on recorded trajectories; `watch` is told the rollouts of each
    /// that are done.
    pub fn of_recordings(
        title: String,
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        watch: &dyn Watch,
    ) -> Self {
        let frames: usize = trials.iter().map(|trial| trial.truth.len()).sum();
        Self {
            title,
            family: CrowdFamily::Recordings,
            set: None,
            seed: None,
            trajectories: trials.len(),
            frames: frames as f64 / trials.len().max(1) as f64,
            models: models.iter().map(|model| evaluate_crowd(&**model, trials, watch)).collect(),
        }
    }
}

/// Errors of one model on one test set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrowdModel {
    /// Name of the model.
    pub model: String,
    /// Over all objects.
    pub all: Phases,
    /// Over the objects whose true motion exceeds 1 cm in the end.
    pub moved: Phases,
    /// Mean heading error at the final frame, moved cuboids of known heading, degrees.
    pub heading_deg: Option<f64>,
    /// Mean error of all objects by horizon.
    pub curve: Vec<CurvePoint>,
    /// Deepest overlap of two objects, or of one with an obstacle, at any compared frame, metres.
    pub overlap: f64,
    /// The same, averaged over trajectories, metres.
    pub overlap_mean: f64,
    /// Drift of fixed, revolute and prismatic joints.
    pub drift: [Drift; 3],
    /// Trajectories in which the prediction left the finite numbers; judged by where it stopped.
    pub failed: usize,
}

/// Errors at the final frame and over all frames; `None` where there are no objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Phases {
    /// At the final frame, when everything rests.
    pub end: Option<RelativeErrors>,
    /// Averaged over the frames of each object.
    pub averaged: Option<RelativeErrors>,
}

/// A point of the curve of error by horizon.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Share of the trajectory's frames that have passed, 0 to 1.
    pub horizon: f64,
    /// Mean error, metres.
    pub error: f64,
    /// Mean true distance from the start, metres.
    pub motion: f64,
}
