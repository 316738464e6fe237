//! Errors of models on trials that are judged together: a test set, or the user's recordings.
//!
//! The tool's motion is given; everything else is rolled out from the first frame alone and
//! compared with the truth at every frame of it.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use pushplan::effect::{Assuming, EffectModel, Simulated};
use pushplan::sim::Simulator;
use pushplan::watch::{Count, Watch};

use super::baselines::SHIFTED_START;
use super::comparison::Comparison;
use super::error::ObjectError;
use super::physical::{Drift, DriftSums};
use super::statistics::{RelativeErrors, mean};
use super::trial::Trial;

/// Steps of the curve of error by horizon: about every ten frames of a sparse trajectory.
const CURVE_STEPS: usize = 20;

/// Errors of several models on trials that are judged together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialErrors {
    /// A line for tables.
    pub title: String,
    /// Number of trajectories.
    pub trajectories: usize,
    /// Mean number of compared frames in one of them.
    pub frames: f64,
    /// One entry a model, in the order in which they were given.
    pub models: Vec<ModelErrors>,
}

impl TrialErrors {
    /// Errors of `models` on `trials`; `watch` is told the rollouts of each that are done.
    pub fn of(
        title: String,
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        watch: &dyn Watch,
    ) -> Self {
        let frames: usize = trials.iter().map(|trial| trial.truth.len()).sum();
        Self {
            title,
            trajectories: trials.len(),
            frames: frames as f64 / trials.len().max(1) as f64,
            models: models.iter().map(|model| model_errors(&**model, trials, watch)).collect(),
        }
    }
}

/// Errors of several models on recordings that are judged together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedErrors {
    /// Names of the recordings.
    pub names: Vec<String>,
    /// How far the planar engine ends from itself when it starts 0.1 mm off, mean over all
    /// objects, metres; `None` if it was not asked for.
    pub own_spread: Option<f64>,
    /// What was measured.
    #[serde(flatten)]
    pub errors: TrialErrors,
}

/// Errors of one model on trials that are judged together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelErrors {
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
    /// Trajectories in which the prediction became NaN or infinite; judged by where it stopped.
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
    /// How far the model itself says that positions will be off, metres; `None` where it says nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<f64>,
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

/// Errors of `model` on `trials`, rolled out on all threads of the current rayon pool;
/// `watch` is told the trajectories done.
fn model_errors(model: &dyn EffectModel, trials: &[Trial], watch: &dyn Watch) -> ModelErrors {
    watch.stage(&model.spec().to_string());
    let count = Count::new(watch, 0, trials.len());
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

/// How far the planar engine ends from itself when every object starts a little off, metres:
/// errors that no model can be expected to undercut. `None` without objects.
pub fn own_spread(trials: &[Trial], watch: &dyn Watch) -> Option<f64> {
    let planar = Simulated::new(Simulator::planar());
    let shifted = Assuming::new(planar.clone(), SHIFTED_START);
    watch.stage("own spread");
    let count = Count::new(watch, 0, trials.len());
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

/// One trajectory, judged.
struct Judged {
    /// Errors of all objects, moment by moment.
    moments: Vec<Vec<ObjectError>>,
    overlap: f64,
    drift: DriftSums,
    failed: bool,
    /// How far the model says that it is off on average, metres.
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

    /// Errors of all objects at the last moment.
    fn end(&self) -> &[ObjectError] {
        self.moments.last().map_or(&[], Vec::as_slice)
    }

    /// Means over the objects at the last moment.
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

    /// Error and motion of an object, averaged over moments, metres.
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
            // At the start nothing has moved and nothing is wrong.
            error: sum(step, &|error| error.position) / objects,
            motion: sum(step, &|error| error.motion) / objects,
        })
        .collect()
}
