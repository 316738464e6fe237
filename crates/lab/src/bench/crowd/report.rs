//! What was measured, as plain data.

use serde::{Deserialize, Serialize};

use pushplan::internals::effect::EffectModel;
use pushplan::internals::judge::{Drift, RelativeErrors, Trial};
use pushplan::internals::watch::Watch;

use super::{
    family::{CrowdFamily, CrowdSet},
    measure::{evaluate_crowd, own_spread},
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
    /// Names of the recordings; empty for drawn sets.
    #[serde(default)]
    pub names: Vec<String>,
    /// Of recordings: how far the planar engine ends from itself when it starts 0.1 mm beside,
    /// mean over all objects, metres; `None` if it was not asked for.
    #[serde(default)]
    pub own_spread: Option<f64>,
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
        let (family, title) = (set.family, set.title());
        Self { set: Some(*set), seed: Some(seed), ..Self::of(family, title, trials, models, watch) }
    }

    /// Errors of `models` on recorded trajectories with these names; `watch` is told the rollouts
    /// of each that are done.
    pub fn of_recordings(
        title: String,
        names: Vec<String>,
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        watch: &dyn Watch,
    ) -> Self {
        Self { names, ..Self::of(CrowdFamily::Recordings, title, trials, models, watch) }
    }

    /// The same beside how far the planar engine ends from itself.
    pub fn with_own_spread(self, trials: &[Trial], watch: &dyn Watch) -> Self {
        Self { own_spread: own_spread(trials, watch), ..self }
    }

    fn of(
        family: CrowdFamily,
        title: String,
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        watch: &dyn Watch,
    ) -> Self {
        let frames: usize = trials.iter().map(|trial| trial.truth.len()).sum();
        Self {
            title,
            family,
            set: None,
            seed: None,
            trajectories: trials.len(),
            frames: frames as f64 / trials.len().max(1) as f64,
            names: Vec::new(),
            own_spread: None,
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
    /// The same of all cuboids of known heading, degrees.
    #[serde(default)]
    pub any_heading_deg: Option<f64>,
    /// Trajectory by trajectory.
    #[serde(default)]
    pub each: Vec<OneError>,
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

/// Errors at the final frame of one trajectory, means over its objects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OneError {
    /// Distance of the predicted from the true positions, metres.
    pub error: f64,
    /// Distance of the true positions from the start, metres.
    pub motion: f64,
    /// Heading error, degrees; `None` without a known heading.
    pub heading_deg: Option<f64>,
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
