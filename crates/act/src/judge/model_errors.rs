//! Errors of models on a group of trials: a test set, or recordings of the user.
//!
//! The tool's motion is given. All else is rolled out from the first frame and compared with the
//! ground truth at every frame of it.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use pushplan::effect::{Assuming, EffectModel, Simulated};
use pushplan::progress::{Count, Progress};
use pushplan::sim::Simulator;

use super::baselines::SHIFTED_START;
use super::comparison::Comparison;
use super::error::ObjectError;
use super::physical::{Drift, DriftSums};
use super::statistics::{RelativeErrors, mean};
use super::trial::Trial;

/// Number of steps of the curve of error by horizon, about every ten frames of a sparse trajectory.
const CURVE_STEPS: usize = 20;

/// Errors of several models on a group of trials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialErrors {
    /// Title for tables.
    pub title: String,
    /// Number of trajectories.
    pub trajectories: usize,
    /// Mean number of compared frames per trajectory.
    pub frames: f64,
    /// Errors per model, in the given order.
    pub models: Vec<ModelErrors>,
}

impl TrialErrors {
    /// Computes the errors of `models` on `trials`; `progress` receives the number of finished
    /// rollouts.
    pub fn of(
        title: String,
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        progress: &dyn Progress,
    ) -> Self {
        let frames: usize = trials.iter().map(|trial| trial.truth.len()).sum();
        Self {
            title,
            trajectories: trials.len(),
            frames: frames as f64 / trials.len().max(1) as f64,
            models: models.iter().map(|model| model_errors(&**model, trials, progress)).collect(),
        }
    }
}

/// Errors of several models on a group of recordings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedErrors {
    /// Names of the recordings.
    pub names: Vec<String>,
    /// Mean final difference of the 2-D engine to itself with a start that is off by 0.1 mm,
    /// metres. `None` if it was not computed.
    pub own_spread: Option<f64>,
    /// Measured errors.
    #[serde(flatten)]
    pub errors: TrialErrors,
}

/// Errors of one model on a group of trials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelErrors {
    /// Name of the model.
    pub model: String,
    /// Errors over all objects.
    pub all: Phases,
    /// Errors over the objects with a final true displacement above 1 cm.
    pub moved: Phases,
    /// Mean final heading error of moved cuboids with known heading, degrees.
    pub heading_deg: Option<f64>,
    /// Mean final heading error of all cuboids with known heading, degrees.
    #[serde(default)]
    pub any_heading_deg: Option<f64>,
    /// Errors per trajectory.
    #[serde(default)]
    pub each: Vec<OneError>,
    /// Mean error of all objects by horizon.
    pub curve: Vec<CurvePoint>,
    /// Maximum overlap of two objects, or of an object with an obstacle, over compared frames,
    /// metres.
    pub overlap: f64,
    /// Mean of the maximum overlap over trajectories, metres.
    pub overlap_mean: f64,
    /// Drift of fixed, revolute and prismatic joints.
    pub drift: [Drift; 3],
    /// Number of trajectories with NaN or infinite predictions; the last finite state is used.
    pub failed: usize,
}

/// Final errors of one trajectory, averaged over its objects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OneError {
    /// Distance from the true to the predicted positions, metres.
    pub error: f64,
    /// Distance of the true positions from the start, metres.
    pub motion: f64,
    /// Heading error, degrees; `None` without a known heading.
    pub heading_deg: Option<f64>,
    /// Position error predicted by the model itself, metres; `None` if it predicts none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<f64>,
}

/// Errors at the final frame and over all frames; `None` without objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Phases {
    /// Errors at the final frame, when all objects rest.
    pub end: Option<RelativeErrors>,
    /// Errors averaged over the frames of each object.
    pub averaged: Option<RelativeErrors>,
}

/// Point of the curve of error by horizon.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Elapsed share of the trajectory's frames, 0 to 1.
    pub horizon: f64,
    /// Mean error, metres.
    pub error: f64,
    /// Mean true distance from the start, metres.
    pub motion: f64,
}

/// Computes the errors of `model` on `trials` on all threads of the current rayon pool; `progress`
/// receives the number of finished trajectories.
fn model_errors(model: &dyn EffectModel, trials: &[Trial], progress: &dyn Progress) -> ModelErrors {
    progress.stage(&model.spec().to_string());
    let count = Count::new(progress, 0, trials.len());
    let judged: Vec<Judged> = trials
        .par_iter()
        .map(|trial| {
            let judged = Judged::of(&Comparison::of(model, trial));
            count.one();
            judged
        })
        .collect();
    let overlaps: Vec<f64> = judged.iter().map(|one| one.overlap).collect();
    let mut drift = DriftSums::default();
    judged.iter().for_each(|one| drift.add(&one.drift));
    let mut moved = judged.iter().flat_map(Judged::end).filter(|object| object.moved());
    let mean_heading = |objects: &mut dyn Iterator<Item = &ObjectError>| {
        let headings: Vec<f64> = objects.filter_map(ObjectError::heading_deg).collect();
        (!headings.is_empty()).then(|| mean(&headings))
    };
    ModelErrors {
        model: model.spec().to_string(),
        all: phases(&judged, |_| true),
        moved: phases(&judged, ObjectError::moved),
        heading_deg: mean_heading(&mut moved),
        any_heading_deg: mean_heading(&mut judged.iter().flat_map(Judged::end)),
        each: judged.iter().map(Judged::one).collect(),
        curve: curve(&judged),
        overlap: overlaps.iter().copied().fold(0.0, f64::max),
        overlap_mean: mean(&overlaps),
        drift: drift.by_kind(),
        failed: judged.iter().filter(|one| one.failed).count(),
    }
}

/// Returns the mean final difference of the 2-D engine to itself with slightly shifted starts,
/// metres. No model can be expected to have smaller errors. Returns `None` without objects.
pub fn own_spread(trials: &[Trial], progress: &dyn Progress) -> Option<f64> {
    let planar = Simulated::new(Simulator::planar());
    let shifted = Assuming::new(planar.clone(), SHIFTED_START);
    progress.stage("spread of the 2-D engine");
    let count = Count::new(progress, 0, trials.len());
    let apart: Vec<Vec<f64>> = trials
        .par_iter()
        .map(|trial| {
            let itself = Comparison::of(&planar, trial).as_truth();
            let errors = Comparison::of(&shifted, &itself).end();
            count.one();
            errors.iter().map(|error| error.position).collect()
        })
        .collect();
    let apart = apart.concat();
    (!apart.is_empty()).then(|| mean(&apart))
}

/// Evaluated trajectory.
struct Judged {
    /// Errors of all objects, moment by moment.
    moments: Vec<Vec<ObjectError>>,
    overlap: f64,
    drift: DriftSums,
    failed: bool,
    /// Mean position error predicted by the model itself, metres.
    expected: Option<f64>,
}

impl Judged {
    fn of(comparison: &Comparison) -> Self {
        let stated = comparison.predicted().spreads.iter().map(|spread| spread.position);
        let stated: Vec<f64> = stated.collect();
        Self {
            moments: comparison.moments(),
            overlap: comparison.overlap(),
            drift: comparison.drift(),
            failed: !comparison.is_finite(),
            expected: (!stated.is_empty()).then(|| mean(&stated)),
        }
    }

    /// Returns the errors of all objects at the last moment.
    fn end(&self) -> &[ObjectError] {
        self.moments.last().map_or(&[], Vec::as_slice)
    }

    /// Returns the means over the objects at the last moment.
    fn one(&self) -> OneError {
        let of = |value: &dyn Fn(&ObjectError) -> f64| {
            mean(&self.end().iter().map(value).collect::<Vec<_>>())
        };
        let headings: Vec<f64> = self.end().iter().filter_map(ObjectError::heading_deg).collect();
        OneError {
            error: of(&|error| error.position),
            motion: of(&|error| error.motion),
            heading_deg: (!headings.is_empty()).then(|| mean(&headings)),
            expected: self.expected,
        }
    }

    /// Returns error and displacement of an object, averaged over moments, metres.
    fn averaged(&self, object: usize) -> [f64; 2] {
        let of = |value: &dyn Fn(&ObjectError) -> f64| {
            let sum: f64 = self.moments.iter().map(|objects| value(&objects[object])).sum();
            sum / self.moments.len().max(1) as f64
        };
        [of(&|error| error.position), of(&|error| error.motion)]
    }
}

fn phases(judged: &[Judged], counts: impl Fn(&ObjectError) -> bool) -> Phases {
    let gather = |pair: &dyn Fn(&Judged, usize) -> [f64; 2]| {
        let of_trial = |one: &Judged| -> Vec<[f64; 2]> {
            let counted = one.end().iter().enumerate().filter(|(_, error)| counts(error));
            counted.map(|(object, _)| pair(one, object)).collect()
        };
        RelativeErrors::of(&judged.iter().map(of_trial).collect::<Vec<_>>())
    };
    Phases {
        end: gather(&|one, object| [one.end()[object].position, one.end()[object].motion]),
        averaged: gather(&|one, object| one.averaged(object)),
    }
}

fn curve(judged: &[Judged]) -> Vec<CurvePoint> {
    let objects = judged.iter().map(|one| one.end().len()).sum::<usize>().max(1) as f64;
    let sum = |step: usize, value: &dyn Fn(&ObjectError) -> f64| -> f64 {
        let of_trial = |one: &Judged| {
            let frame = (one.moments.len() * step).div_ceil(CURVE_STEPS).checked_sub(1);
            let errors = frame.map_or(&[][..], |frame| one.moments[frame].as_slice());
            errors.iter().fold(0.0, |sum, error| sum + value(error))
        };
        judged.iter().map(of_trial).sum()
    };
    (0..=CURVE_STEPS)
        .map(|step| CurvePoint {
            horizon: step as f64 / CURVE_STEPS as f64,
            // At the start all displacements and errors are zero.
            error: sum(step, &|error| error.position) / objects,
            motion: sum(step, &|error| error.motion) / objects,
        })
        .collect()
}
