//! Judging models on a test set.

use rayon::prelude::*;

use pushplan::internals::effect::{Assuming, EffectModel, Simulated};
use pushplan::internals::judge::{Comparison, DriftSums, ObjectError, RelativeErrors, Trial, mean};
use pushplan::internals::sim::Simulator;
use pushplan::internals::watch::{Count, Watch};

use super::super::baselines::SHIFTED_START;
use super::report::{CrowdModel, CurvePoint, OneError, Phases};

/// Steps of the curve of error by horizon: about every ten frames of a sparse trajectory.
const CURVE_STEPS: usize = 20;

/// Errors of `model` on `trials`, rolled out on all threads of the current rayon pool;
/// `watch` is told the trajectories done.
pub fn evaluate_crowd(model: &dyn EffectModel, trials: &[Trial], watch: &dyn Watch) -> CrowdModel {
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
    CrowdModel {
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

/// How far the planar engine ends from itself when every object starts a little beside, metres:
/// errors that no model can be expected to undercut. `None` without objects.
pub(super) fn own_spread(trials: &[Trial], watch: &dyn Watch) -> Option<f64> {
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
}

impl Judged {
    fn of(comparison: &Comparison) -> Self {
        Self {
            moments: comparison.moments(),
            overlap: comparison.overlap(),
            drift: comparison.drift(),
            failed: !comparison.is_finite(),
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
